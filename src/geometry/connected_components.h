// The parts of a shape that hang together, and which of them enclose a space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/shape.h"

namespace stilb::geometry {

/// The shells of a shape: triangles that hang together along edges. Vertices at the same place are one
/// vertex, as files often repeat them.
struct ConnectedComponents {
    /// Per triangle (Hit::triangle), the shell that it belongs to.
    std::vector<std::uint32_t> of_triangle;
    /// Per shell, the edges in which an odd number of triangles meet. 0: the shell is closed, every ray from
    /// inside of it meets it an odd number of times.
    std::vector<std::size_t> open_edges;
    /// Edges of two triangles whose fronts lie on different sides of the surface.
    std::size_t turned_edges = 0;

    std::size_t count() const { return open_edges.size(); }
    bool is_closed(std::uint32_t shell) const { return open_edges[shell] == 0; }
    std::size_t total_open_edges() const;
};

ConnectedComponents find_components(const Mesh& mesh);
/// Spheres are one closed shell, disks an open one (their rim counts as one edge).
ConnectedComponents find_components(const Shape& shape);

}  // namespace stilb::geometry
