// The triangles that a walk draws, with the direct light at their vertices.
//
// They start from the patches. Each side that can be seen becomes triangles of its own, so that back faces
// can be culled and walls can be looked through from behind. Edges are halved where the direct light between
// their ends is not linear, at shadow edges and near lamps, and where a curved surface bulges between them,
// down to a least length and up to a budget of triangles, which goes where relative error x area x length is
// largest. An edge is halved for all triangles that share its two ends, of all objects, and a triangle at its
// longest edge first [Rivara 1984]: so neighbours always fit each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/monitor.h"
#include "geometry/shape.h"
#include "math/sampling.h"
#include "patches/patches.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::walk {

struct DisplayOptions {
    /// The budget; more where the patches alone have more.
    std::size_t most_triangles = 80'000;
    /// No shorter edge is halved, as a share of the scene's extent.
    double shortest_edge = 1. / 400;
    /// The error in an edge's middle that is small enough, as a share of the illuminance there.
    double tolerance = 0.02;
};

/// The largest number of patches that a walk takes.
inline constexpr std::size_t kMostWalkPatches = 2'000'000;

struct DisplayVertex {
    Vec3 position;           ///< world [m]
    Vec3 normal;             ///< unit, of the smooth surface, towards the side
    std::uint32_t side = 0;  ///< of a patch that it lies on
    math::Barycentric barycentric{};
};

/// Triangles of one side of an object and of one material.
struct DisplayPart {
    ObjectId object{};
    MaterialId material{};
    bool is_front = true;
    std::size_t first = 0, count = 0;
};

struct DisplayMesh {
    std::vector<DisplayVertex> vertices;
    std::vector<Triangle> triangles;  ///< counterclockwise as seen from their side
    std::vector<DisplayPart> parts;   ///< all triangles, in order
    /// Illuminance by each light, luminance-weighted [lx]: light x vertices + vertex. 0 on mirrors and glass.
    std::vector<float> direct_lx;
    /// Per vertex: half-width of the 95 % interval of all lights together, sampling and interpolation.
    std::vector<float> direct_error_lx;
};

/// `carries_light`: per side of a patch, whether there is reflected light on it. Other sides are left out,
/// except those that direct light reaches, emitters, mirrors and glass. Throws InputError where there are too
/// many patches, Cancelled as the monitor says.
DisplayMesh make_display_mesh(const Scene& scene, const rays::RayCaster& caster,
                              const patches::Patches& patches, const std::vector<bool>& carries_light,
                              const DisplayOptions& options = {}, const Monitor& monitor = Monitor::none());

}  // namespace stilb::walk
