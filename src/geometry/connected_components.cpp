#include "geometry/connected_components.h"

#include <numeric>
#include <utility>

#include "geometry/mesh_edges.h"
#include "math/disjoint_sets.h"

namespace stilb::geometry {

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
    ConnectedComponents shells{std::move(of_triangle), std::vector<std::size_t>(count), 0};
    for_each_edge(uses, [&](auto first, auto last) {
        const auto times = last - first;
        if (times % 2 != 0) ++shells.open_edges[shells.of_triangle[first->triangle]];
        if (times == 2 && first->upwards == (first + 1)->upwards) ++shells.turned_edges;
    });
    return shells;
}

ConnectedComponents find_components(const Shape& shape) {
    struct Finder {
        ConnectedComponents operator()(const Mesh& mesh) const { return find_components(mesh); }
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
