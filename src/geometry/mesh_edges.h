// Which triangles of a mesh meet in which edge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape.h"

namespace stilb::geometry {

/// Per vertex, the first of those at the same place: files often repeat them.
std::vector<std::uint32_t> welded(std::span<const Vec3> vertices);

/// An edge as one of its triangles has it: between vertices low < high, run along from low to high or not.
struct EdgeUse {
    std::uint32_t low, high, triangle;
    bool upwards;

    bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// All uses of all edges, those of the same edge one after another in the order of triangles. `vertex_at` is
/// what welded() says.
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

}  // namespace stilb::geometry
