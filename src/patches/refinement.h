// Meshes made finer, without T-junctions.
//
// Every edge that is too long is halved, whatever triangles meet in it, until none is. Whether an edge is
// halved, and where, thus depends on its two ends alone: neighbours always agree, also those of other objects
// along edges that they share. A triangle is halved at its longest edge first, which keeps its angles from
// becoming small [Rivara 1984, Algorithms for refining triangular grids].
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/shape.h"

namespace stilb::patches {

/// The place of a new vertex between two others; the same for (a, b) and (b, a).
using MiddleOf = std::function<Vec3(const Vec3& a, const Vec3& b)>;

struct RefinedMesh {
    Mesh mesh;
    /// Per triangle, the one of the coarse mesh that it is part of. Those of the same parent follow one
    /// another, and the parents stand in their order.
    std::vector<std::uint32_t> parents;
};

/// `coarse` with all edges halved until none is longer than `longest_edge_m` (but for rounding). Triangles
/// keep their front.
RefinedMesh refined(Mesh coarse, double longest_edge_m, const MiddleOf& middle_of);

}  // namespace stilb::patches
