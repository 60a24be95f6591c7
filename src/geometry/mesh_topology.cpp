
#include "geometry/mesh_topology.h"

#include <numeric>
#include <tuple>
#include <utility>

#include "math/disjoint_sets.h"

namespace stilb::geometry {

std::vector<std::uint32_t> welded(std::span<const Vec3> vertices) {
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto position = [&](std::uint32_t i) {
        return std::tie(vertices[i].x, vertices[i].y, vertices[i].z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return position(a) != position(b) ? position(a) < position(b) : a < b;
    });
    std::vector<std::uint32_t> first(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_repeated = i > 0 && position(order[i]) == position(order[i - 1]);
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

std::size_t ConnectedComponents::total_open_edges() const {
    return std::accumulate(open_edges.begin(), open_edges.end(), std::size_t{0});
}

ConnectedComponents find_components(const Mesh& mesh) {
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangles, welded(mesh.vertices));
    math::DisjointSets groups(mesh.triangles.size());
    for_each_edge(uses, [&](auto first, auto last) {
        for (auto use = first + 1; use != last; ++use) groups.join(first->triangle, use->triangle);
    });
    auto [of_triangle, count] = groups.numbered();
    ConnectedComponents components{std::move(of_triangle), std::vector<std::size_t>(count), 0};
    for_each_edge(uses, [&](auto first, auto last) {
        const auto times = last - first;
        if (times % 2 != 0) ++components.open_edges[components.of_triangle[first->triangle]];
        if (times == 2 && first->upwards == (first + 1)->upwards) ++components.turned_edges;
    });
    return components;
}

ConnectedComponents find_components(const Shape& shape) {
    struct Finder {
        ConnectedComponents operator()(const Mesh& mesh) const { return find_components(mesh); }
        ConnectedComponents operator()(const Instance& instance) const {
            return find_components(*instance.mesh);
        }
        ConnectedComponents operator()(const Rectangle& rectangle) const {
            return find_components(triangulated(rectangle));
        }
        ConnectedComponents operator()(const Box& box) const { return find_components(triangulated(box)); }
        ConnectedComponents operator()(const Sphere&) const { return {{0}, {0}, 0}; }
        ConnectedComponents operator()(const Harmonics&) const { return {{0}, {0}, 0}; }
        ConnectedComponents operator()(const Disk&) const { return {{0}, {1}, 0}; }
    };
    return std::visit(Finder{}, shape);
}

}  // namespace stilb::geometry
