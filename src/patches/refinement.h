// Meshes made finer, without T-junctions.
//
// Whether an edge is halved is decided for the edge, in all triangles that share it, so neighbours always
// agree. A triangle is halved at its longest edge first, which keeps its angles from becoming small [Rivara
// 1984, Algorithms for refining triangular grids].
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/shape.h"

namespace stilb::patches {

/// The position of a new vertex between two others; the same for (a, b) and (b, a).
using MiddleOf = std::function<Vec3(const Vec3& a, const Vec3& b)>;

struct RefinedMesh {
    Mesh mesh;
    /// For each triangle, its parent in the coarse mesh. Triangles of the same parent follow one
    /// another, in the order of the parents.
    std::vector<std::uint32_t> parents;
};

/// The mesh as its own refinement: each triangle is its own parent.
RefinedMesh unrefined(Mesh mesh);

/// An edge between two vertices.
struct Edge {
    std::uint32_t a = 0, b = 0;
    double squared_length_m2 = 0;
};
/// A number for the edge between two vertices, the same for (a, b) and (b, a).
constexpr std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

/// The same for (a, b) and (b, a).
using IsTooLong = std::function<bool(const Edge&)>;

/// Halves all edges that are too long once, and of their triangles the longest edges too. Triangles keep
/// their front. Returns false where there was no such edge.
bool halve_edges(RefinedMesh& refined, const IsTooLong& is_too_long, const MiddleOf& middle_of);

/// `coarse` with all edges halved until none is longer than `longest_edge_m` (up to rounding). Neighbours
/// agree also along edges that triangles of several meshes share.
RefinedMesh refined(Mesh coarse, double longest_edge_m, const MiddleOf& middle_of);

}  // namespace stilb::patches
