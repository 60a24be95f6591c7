// Faces of a mesh that lie twice in one place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape.h"

namespace stilb::geometry {

struct RepeatedFace {
    std::uint32_t triangle = 0;
    std::uint32_t original = 0;  ///< one of those that lie there, too
};

/// Of some triangles of a mesh, in the order of their numbers, those that earlier ones cover, in the same
/// plane and with the same front; all but the first where several are equal. Of polygons that were cut into
/// triangles in different ways, too. They have a corner in common with those that cover them.
std::vector<RepeatedFace> repeated_faces(const Mesh& mesh, std::span<const std::uint32_t> triangles);

/// The same of all triangles.
std::vector<RepeatedFace> repeated_faces(const Mesh& mesh);

}  // namespace stilb::geometry
