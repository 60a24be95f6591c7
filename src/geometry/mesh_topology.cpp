
#include "geometry/mesh_topology.h"

#include <array>
#include <bit>
#include <numeric>
#include <tuple>
#include <utility>

#include "math/disjoint_sets.h"

namespace stilb::geometry {

namespace {

/// Equal for equal positions, also for -0 and 0.
std::uint64_t hash_of(const Vec3& position) {
    std::uint64_t hash = 0;
    for (const double coordinate : {position.x, position.y, position.z}) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9e3779b97f4a7c15;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace

std::vector<std::uint32_t> welded(std::span<const Vec3> vertices) {
    constexpr std::uint32_t none = ~0u;
    // An open hash table, at most half full.
    std::vector<std::uint32_t> table(std::bit_ceil(2 * vertices.size() + 1), none);
    std::vector<std::uint32_t> first(vertices.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        std::size_t at = hash_of(vertices[i]) & (table.size() - 1);
        while (table[at] != none && vertices[table[at]] != vertices[i]) at = (at + 1) & (table.size() - 1);
        if (table[at] == none) table[at] = i;
        first[i] = table[at];
    }
    return first;
}

Edges::Edges(std::span<const Triangle> triangles, std::vector<std::uint32_t> vertex_at)
    : triangles_(triangles), vertex_at_(std::move(vertex_at)), ends_(vertex_at_.size() + 1) {
    for_each_low_vertex([&](std::uint32_t low, std::uint32_t) { ++ends_[low + 1]; });
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    listed_.resize(ends_.back());
    // The begin of each list moves to its end.
    for_each_low_vertex([&](std::uint32_t low, std::uint32_t t) { listed_[ends_[low]++] = t; });
}

/// Calls `visit(vertex, triangle)` for the lower vertices of each triangle's sides, once for each.
template <typename Visitor>
void Edges::for_each_low_vertex(const Visitor& visit) const {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        std::array<std::uint32_t, 3> low;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [from, to] = side(t, i);
            low[i] = std::min(from, to);
        }
        visit(low[0], t);
        if (low[1] != low[0]) visit(low[1], t);
        if (low[2] != low[0] && low[2] != low[1]) visit(low[2], t);
    }
}

void Edges::find_uses(std::uint32_t low, std::vector<EdgeUse>& uses) const {
    uses.clear();
    for (std::size_t i = low == 0 ? 0 : ends_[low - 1]; i < ends_[low]; ++i) {
        const std::uint32_t t = listed_[i];
        for (std::size_t number = 0; number < 3; ++number) {
            const auto [from, to] = side(t, number);
            if (std::min(from, to) == low) uses.push_back({low, std::max(from, to), t, from < to});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
    });
}

std::size_t ConnectedComponents::total_open_edges() const {
    return std::accumulate(open_edges.begin(), open_edges.end(), std::size_t{0});
}

ConnectedComponents find_components(const Mesh& mesh) {
    const Edges edges(mesh);
    math::DisjointSets groups(mesh.triangles.size());
    edges.for_each([&](auto first, auto last) {
        for (auto use = first + 1; use != last; ++use) groups.join(first->triangle, use->triangle);
    });
    auto [of_triangle, count] = std::move(groups).numbered();
    ConnectedComponents components{std::move(of_triangle), std::vector<std::size_t>(count), 0};
    edges.for_each([&](auto first, auto last) {
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

bool nearly_closes(const Vec3& vector_area, double area, std::size_t open_edges, std::size_t triangles) {
    // The vector area of a closed surface is 0; that of an open one is the area of its holes, if flat. A box
    // without a lid (0.2 of its area, or more for a flat one) is open on purpose.
    constexpr double largest_hole = 0.05;
    // From this share of open edges among its triangles on, a surface is a tube that is open on purpose: both
    // ends of a tube have opposite vector areas.
    constexpr double edges_of_tube = 0.5;
    return length(vector_area) <= largest_hole * area &&
           static_cast<double>(open_edges) < edges_of_tube * static_cast<double>(triangles);
}

}  // namespace stilb::geometry
