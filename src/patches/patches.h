// The surfaces of a scene as small triangles (patches), for methods that store a value for each part of a
// surface.
//
// All shapes become triangles: spheres an inscribed polyhedron, disks a polygon, both with every vertex on
// the true shape, so that their areas fall short by a share in proportion to (edge / radius)^2 (2 % at the
// coarsest, see kLongestCurvedEdge). Edges are halved until none is longer than the patch size
// (refinement.h). Patches on lights, mirrors and glass are treated like others.
//
// A patch has two sides, as materials reflect on both. Sides are numbered: the front of patch p is p, its
// back p + count(), so that the fronts' values come first in arrays of 2 count() values, and those of the
// backs after them. The front is the side from which the vertices run counterclockwise; only fronts of area
// lights emit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/ids.h"
#include "base/monitor.h"
#include "base/vec.h"
#include "geometry/shape.h"
#include "math/sampling.h"
#include "scene/scene.h"

namespace stilb::patches {

/// Single precision, for large arrays.
struct Float3 {
    float x = 0, y = 0, z = 0;

    explicit operator Vec3() const { return {x, y, z}; }
};

/// The side index that stands for no side.
inline constexpr std::uint32_t kNoSide = ~0u;

/// In the order of the scene's objects and, in a mesh, of its triangles, so that neighbours in number are
/// neighbours in space. About 40 bytes each.
struct Patches {
    Vec3 center;  ///< the origin of `vertices`
    std::vector<Float3>
        vertices;  ///< [m], divided at creases (vertex_interpolation.h), so positions occur repeatedly
    std::vector<Triangle> corners;                  ///< per patch, of `vertices`
    std::vector<Float3> normals;                    ///< per patch: geometric, unit, on the front
    std::vector<float> areas_m2;                    ///< per patch, one side
    std::vector<MaterialId> materials;              ///< per patch
    std::vector<std::uint32_t> first_of_object{0};  ///< per object, and the number of patches at the end

    std::size_t count() const { return corners.size(); }
    ObjectId object_of(std::uint32_t patch) const;
    /// In world coordinates [m], rounded to 2^-24 of the distance from `center`.
    Vec3 position(std::uint32_t patch, const math::Barycentric& barycentric) const;
    Vec3 middle(std::uint32_t patch) const;

    /// Precondition: side != kNoSide.
    std::uint32_t patch_of(std::uint32_t side) const { return is_front(side) ? side : other_side(side); }
    bool is_front(std::uint32_t side) const { return side < count(); }
    std::uint32_t other_side(std::uint32_t side) const {
        const auto fronts = static_cast<std::uint32_t>(count());
        return side < fronts ? side + fronts : side - fronts;
    }
    /// Unit, away from that side.
    Vec3 normal_of(std::uint32_t side) const;
    /// `scene`: that of the patches.
    MaterialId material_of(const Scene& scene, std::uint32_t side) const {
        return scene.on_side(materials[patch_of(side)], is_front(side));
    }
};

/// The longest edge of a sphere or of a disk's rim, over the radius, for any patch size.
inline constexpr double kLongestCurvedEdge = 0.4;
inline constexpr std::size_t kMostPatches = 100'000'000;

/// Patches whose edges are no longer than `longest_edge_m`; triangles without area are left out. Their centre
/// is the middle of the bounding box; of large scenes (scene::kLargeHalfExtent_m) it is `exact_at`, if given.
/// Throws InputError where the size is not above 0, and where there would be more than about kMostPatches;
/// Cancelled as the monitor says.
Patches make_patches(const Scene& scene, double longest_edge_m, const Monitor& monitor = Monitor::none(),
                     const std::optional<Vec3>& exact_at = {});

/// The longest edge [m] that a part of a patch may have, by the patch's number and the corners of the part.
/// Called in parallel.
using LongestEdge = std::function<double(std::uint32_t patch, const std::array<Vec3, 3>& corners)>;

/// Patches divided into finer ones where something changes quickly.
struct FinePatches {
    Patches patches;
    std::vector<std::uint32_t> parents;  ///< per fine patch: the number of the coarse one
};
/// The patches of make_patches(scene, size_m), divided until no edge is longer than the limit of the patches
/// that share it, or until there are about `most`. `exact_at`: as above.
FinePatches make_fine_patches(const Scene& scene, double size_m, const LongestEdge& longest_edge_m,
                              std::size_t most, const Monitor& monitor = Monitor::none(),
                              const std::optional<Vec3>& exact_at = {});

/// Bounds of all vertices, relative to Patches::center [m].
Bounds bounds_of(const Patches& patches);
/// The longest edge with which the scene has about `count` patches (within a factor of two where its surfaces
/// are large against that).
double patch_size_m(const Scene& scene, double count = 10'000);

}  // namespace stilb::patches
