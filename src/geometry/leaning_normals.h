// Vertex normals that cannot be those of a surface which the triangles approximate.
#pragma once

#include <cstddef>

#include "geometry/shape.h"

namespace stilb::geometry {

/// Of a smooth surface that triangles approximate the normals lean by less than this at their centres.
inline constexpr double kMostLean_deg = 45;

/// Makes triangles flat whose normals lean away from them by more, because light would be lost there. Returns
/// their number.
std::size_t drop_leaning_normals(Mesh& mesh);

}  // namespace stilb::geometry
