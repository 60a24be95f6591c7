// Topology of meshes: triangles that share edges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
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
};

/// The edges of some triangles, in little memory (about 8 bytes for each triangle and each vertex): their
/// uses are put together one edge after the other. Keeps a reference to the triangles.
class Edges {
  public:
    /// `vertex_at`: the result of welded().
    Edges(std::span<const Triangle> triangles, std::vector<std::uint32_t> vertex_at);
    explicit Edges(const Mesh& mesh) : Edges(mesh.triangles, welded(mesh.vertices)) {}

    /// Calls `visit(first, last)` for the uses of every edge, which are in the order of triangles. The edges
    /// are in the order of their vertices.
    template <typename Visitor>
    void for_each(const Visitor& visit) const {
        std::vector<EdgeUse> uses;
        for (std::uint32_t low = 0; low < vertex_at_.size(); ++low) {
            find_uses(low, uses);
            for (auto first = uses.cbegin(); first != uses.cend();) {
                const auto last = std::find_if(first, uses.cend(),
                                               [&](const EdgeUse& use) { return use.high != first->high; });
                visit(first, last);
                first = last;
            }
        }
    }

  private:
    /// The vertices of a triangle's side.
    std::pair<std::uint32_t, std::uint32_t> side(std::uint32_t triangle, std::size_t number) const {
        const Triangle& corners = triangles_[triangle];
        return {vertex_at_[corners[number]], vertex_at_[corners[(number + 1) % 3]]};
    }
    template <typename Visitor>
    void for_each_low_vertex(const Visitor& visit) const;
    /// Replaces `uses` by those of the edges from a vertex to higher ones, sorted.
    void find_uses(std::uint32_t low, std::vector<EdgeUse>& uses) const;

    std::span<const Triangle> triangles_;
    std::vector<std::uint32_t> vertex_at_;
    /// The triangles with an edge whose lower vertex is 0, those of vertex 1 and so on, and where they end.
    std::vector<std::uint32_t> listed_;
    std::vector<std::size_t> ends_;
};

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

/// Whether a connected component with open edges is nearly closed, as if a few of its triangles were missing.
/// `vector_area` and `area`: sums over its triangles, in one unit.
bool nearly_closes(const Vec3& vector_area, double area, std::size_t open_edges, std::size_t triangles);

}  // namespace stilb::geometry
