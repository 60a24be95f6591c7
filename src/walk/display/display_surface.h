// The sides of patches as triangles of their own, each seen from one side: the start of the display mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/shape.h"
#include "patches/patches.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "walk/display/vertex_light.h"

namespace stilb::walk {

struct SurfaceVertex {
    Vec3 position;            ///< world [m]
    Vec3 normal;              ///< unit, of the smooth surface, towards the side
    std::uint32_t place = 0;  ///< equal for vertices at the same position
};

/// Single precision is exact: coordinates are halves of halves.
using CornerWeights = std::array<float, 3>;

/// Counterclockwise as seen from its side.
struct SurfaceTriangle {
    Triangle corners{};
    std::uint32_t side = 0;                    ///< of a patch
    std::array<CornerWeights, 3> barycentric;  ///< of each corner, in the patch
};

struct DisplaySurface {
    std::vector<SurfaceVertex> vertices;
    std::vector<SurfaceTriangle> triangles;
    std::uint32_t places = 0;

    Vec3 middle(const SurfaceTriangle& triangle) const;
    /// The middle of the edge opposite to a corner.
    Vec3 opposite(const SurfaceTriangle& triangle, std::uint32_t corner) const {
        return 1.5 * middle(triangle) - 0.5 * vertices[corner].position;
    }
    double area_m2(const SurfaceTriangle& triangle) const;
};

/// Both sides of all patches. Sides have vertices of their own, which are shared as those of the patches are.
DisplaySurface make_display_surface(const Scene& scene, const rays::RayCaster& caster,
                                    const patches::Patches& patches);

/// The vertex that halves an edge on a side of a patch, on the true surface; without its place.
SurfaceVertex middle_between(const Shape& shape, const SurfaceVertex& a, const SurfaceVertex& b);

/// For each vertex, the triangles around it, in the order of triangles.
class TrianglesAround {
  public:
    explicit TrianglesAround(const DisplaySurface& surface);

    std::span<const std::uint32_t> of(std::uint32_t vertex) const {
        return std::span(triangles_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
    }

  private:
    std::vector<std::uint32_t> first_, triangles_;
};

}  // namespace stilb::walk
