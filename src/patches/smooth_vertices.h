// Vertices for values that vary smoothly: one for each smooth part of surface around a point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "geometry/shape.h"

namespace stilb::patches {

/// Where neighbours' normals differ by more, their common edge is one of the object's own and not a step of a
/// curve made of triangles: a cylinder of ten sides is round, one of eight has edges.
inline constexpr double kCreaseAngle_deg = 40;

struct SmoothVertices {
    std::vector<Triangle> triangles;      ///< of the smooth vertices
    std::vector<std::uint32_t> original;  ///< per smooth vertex, the one that it stands at
};

/// Divides the vertices of a mesh so that triangles share one where a path around it leads from one to the
/// other over smooth edges alone: edges of two triangles of the same material, whose fronts lie on the same
/// side and whose normals differ by kCreaseAngle_deg at most. `normals` and `materials` are those of the
/// triangles.
SmoothVertices divide_at_creases(std::span<const Triangle> triangles, std::span<const Vec3> normals,
                                 std::span<const MaterialId> materials);

}  // namespace stilb::patches
