#include "geometry/mesh_edges.h"

#include <numeric>
#include <tuple>

namespace stilb::geometry {

std::vector<std::uint32_t> welded(std::span<const Vec3> vertices) {
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto place = [&](std::uint32_t i) { return std::tie(vertices[i].x, vertices[i].y, vertices[i].z); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return place(a) != place(b) ? place(a) < place(b) : a < b;
    });
    std::vector<std::uint32_t> first(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_repeated = i > 0 && place(order[i]) == place(order[i - 1]);
        first[order[i]] = is_repeated ? first[order[i - 1]] : order[i];
    }
    return first;
}

std::vector<EdgeUse> edge_uses(std::span<const Triangle> triangles,
                               std::span<const std::uint32_t> vertex_at) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t from = vertex_at[triangles[t][side]];
            const std::uint32_t to = vertex_at[triangles[t][(side + 1) % 3]];
            uses.push_back({std::min(from, to), std::max(from, to), t, from < to});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return uses;
}

}  // namespace stilb::geometry
