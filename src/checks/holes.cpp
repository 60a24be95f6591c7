#include "checks/holes.h"

#include <fmt/format.h>

namespace stilb::checks {
namespace {

/// The vector area of a closed surface is 0; that of an open one is as large as its holes, seen flat. A box
/// without a lid (0.2 of its area, or more for a flat one) is meant so.
constexpr double kLargestHole = 0.05;

struct Hole {
    std::size_t shells = 0, edges = 0;
};

Hole holes_of(const Mesh& mesh, const geometry::ConnectedComponents& shells) {
    std::vector<Vec3> vector_area(shells.count());
    std::vector<double> area(shells.count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const Vec3 doubled = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        vector_area[shells.of_triangle[t]] += doubled;
        area[shells.of_triangle[t]] += length(doubled);
    }
    Hole hole;
    for (std::uint32_t s = 0; s < shells.count(); ++s) {
        if (shells.is_closed(s) || length(vector_area[s]) > kLargestHole * area[s]) continue;
        ++hole.shells;
        hole.edges += shells.open_edges[s];
    }
    return hole;
}

}  // namespace

std::vector<std::string> hole_warnings(const Scene& scene,
                                       const std::vector<geometry::ConnectedComponents>& shells) {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const auto* mesh = std::get_if<Mesh>(&object.shape);
        if (mesh == nullptr) continue;
        const Hole hole = holes_of(*mesh, shells[i]);
        if (hole.shells == 0) continue;
        const std::string which = shells[i].count() == 1 ? "it nearly closes"
                                                         : fmt::format("{} of its {} parts nearly close",
                                                                       hole.shells, shells[i].count());
        warnings.push_back(
            fmt::format("object \"{}\": {}, but for {} open edges: light goes through the holes. Close them, "
                        "or leave them "
                        "if they are meant.",
                        object.name, which, hole.edges));
    }
    for (const Light& light : scene.lights) {
        const auto surface = lights::surface_emission(light);
        if (!surface || shells[index_of(surface->object)].turned_edges == 0) continue;
        warnings.push_back(fmt::format(
            "light \"{}\": at {} edges of object \"{}\" the front changes sides, and only fronts shine. Turn "
            "its triangles to one side.",
            light.name, shells[index_of(surface->object)].turned_edges, scene.object(surface->object).name));
    }
    return warnings;
}

}  // namespace stilb::checks
