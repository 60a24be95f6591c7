// Topology of meshes: triangles that share edges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/shared_list.h"
#include "geometry/shape.h"

namespace stilb::geometry {

/// For each vertex, the first vertex at the same position, because files often repeat vertices.
std::vector<std::uint32_t> welded(std::span<const Vec3> vertices);

/// An edge as used by one of its triangles: between vertices low < high, traversed from low to high or not.
struct EdgeUse {
    std::uint32_t low, high, triangle;
    bool upwards;

    bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// All uses of all edges, those of the same edge one after another in the order of triangles. `vertex_at` is
/// the result of welded().
std::vector<EdgeUse> edge_uses(std::span<const Triangle> triangles, std::span<const std::uint32_t> vertex_at);

/// Calls `visit(first, last)` for the uses of every edge.
template <typename Visitor>
void for_each_edge(const std::vector<EdgeUse>& uses, const Visitor& visit) {
    for (auto first = uses.begin(); first != uses.end();) {
        const auto last =
            std::find_if(first, uses.end(), [&](const EdgeUse& use) { return !use.same_edge(*first); });
        visit(first, last);
        first = last;
    }
}

// The connected components of a shape, and which of them are closed.

/// The connected components of a shape: triangles connected along edges. Vertices at the same position count
/// as one vertex, because files often repeat them.
struct ConnectedComponents {
    /// For each triangle (Hit::triangle), its component.
    SharedList<std::uint32_t> of_triangle;
    /// For each component, the number of edges with an odd number of triangles. 0: the component is closed,
    /// every ray from inside of it meets it an odd number of times.
    std::vector<std::size_t> open_edges;
    /// Edges of two triangles whose fronts lie on different sides of the surface.
    std::size_t turned_edges = 0;

    std::size_t count() const { return open_edges.size(); }
    bool is_closed(std::uint32_t component) const { return open_edges[component] == 0; }
    std::size_t total_open_edges() const;
};

ConnectedComponents find_components(const Mesh& mesh);
/// Spheres are one closed component, disks an open one (their rim counts as one edge).
ConnectedComponents find_components(const Shape& shape);

}  // namespace stilb::geometry
