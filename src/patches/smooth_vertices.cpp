#include "patches/smooth_vertices.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/mesh_edges.h"
#include "math/disjoint_sets.h"

namespace stilb::patches {
namespace {

/// Corners of triangles are numbered 3 triangle + place.
std::uint32_t corner_at(std::span<const Triangle> triangles, std::uint32_t triangle, std::uint32_t vertex) {
    const Triangle& corners = triangles[triangle];
    return 3 * triangle + static_cast<std::uint32_t>(std::ranges::find(corners, vertex) - corners.begin());
}

std::vector<geometry::EdgeUse> sorted_edges(std::span<const Triangle> triangles) {
    std::uint32_t vertices = 0;
    for (const Triangle& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    std::vector<std::uint32_t> itself(vertices);
    std::iota(itself.begin(), itself.end(), 0u);
    return geometry::edge_uses(triangles, itself);
}

}  // namespace

SmoothVertices divide_at_creases(std::span<const Triangle> triangles, std::span<const Vec3> normals,
                                 std::span<const MaterialId> materials) {
    const double least_cosine = std::cos(kCreaseAngle_deg * std::numbers::pi / 180);
    const auto is_smooth = [&](const geometry::EdgeUse& a, const geometry::EdgeUse& b) {
        return a.upwards != b.upwards && materials[a.triangle] == materials[b.triangle] &&
               dot(normals[a.triangle], normals[b.triangle]) >= least_cosine;
    };
    math::DisjointSets corners(3 * triangles.size());
    for_each_edge(sorted_edges(triangles), [&](auto first, auto last) {
        if (last - first != 2 || !is_smooth(first[0], first[1])) return;
        for (const std::uint32_t vertex : {first->low, first->high}) {
            corners.join(corner_at(triangles, first[0].triangle, vertex),
                         corner_at(triangles, first[1].triangle, vertex));
        }
    });
    const auto [vertex_of_corner, count] = corners.numbered();
    SmoothVertices smooth{std::vector<Triangle>(triangles.size()), std::vector<std::uint32_t>(count)};
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t vertex = vertex_of_corner[3 * t + i];
            smooth.triangles[t][i] = vertex;
            smooth.original[vertex] = triangles[t][i];
        }
    }
    return smooth;
}

}  // namespace stilb::patches
