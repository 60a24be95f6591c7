
#include <fmt/format.h>

#include "base/vec.h"
#include "checks/checks.h"
#include "checks/walks.h"

namespace stilb::checks {

namespace {

/// More objects than this are one sentence.
constexpr std::size_t kMostSentences = 3;

struct Hole {
    std::size_t components = 0, edges = 0;
};

Hole holes_of(const Mesh& mesh, const geometry::ConnectedComponents& components) {
    std::vector<std::size_t> triangles(components.count());
    std::vector<Vec3> vector_area(components.count());
    std::vector<double> area(components.count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const Vec3 doubled = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        vector_area[components.of_triangle[t]] += doubled;
        area[components.of_triangle[t]] += length(doubled);
        ++triangles[components.of_triangle[t]];
    }
    Hole hole;
    for (std::uint32_t s = 0; s < components.count(); ++s) {
        const std::size_t open_edges = components.open_edges[s];
        if (open_edges == 0 || !geometry::nearly_closes(vector_area[s], area[s], open_edges, triangles[s]))
            continue;
        ++hole.components;
        hole.edges += open_edges;
    }
    return hole;
}

}  // namespace

std::vector<std::string> hole_warnings(const Scene& scene,
                                       const std::vector<geometry::ConnectedComponents>& components) {
    std::vector<std::string> warnings, names;
    std::size_t edges = 0;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const Mesh* mesh = geometry::stored_mesh(object.shape);
        if (mesh == nullptr || object.cut_from) continue;  // a part of a mesh is open
        const Hole hole = holes_of(*mesh, components[i]);
        if (hole.components == 0) continue;
        const std::string which = components[i].count() == 1
                                      ? "it nearly closes"
                                      : fmt::format("{} of its {} parts nearly close{}", hole.components,
                                                    components[i].count(), hole.components == 1 ? "s" : "");
        names.push_back(object.name);
        edges += hole.edges;
        warnings.push_back(fmt::format(
            "object \"{}\": {}, except for {} open edges: light passes through the holes. Close them, "
            "or leave them "
            "if they are meant.",
            object.name, which, hole.edges));
    }
    if (names.size() > kMostSentences) {
        warnings = {
            fmt::format("objects {}: they or parts of them nearly close, except for {} open edges: light "
                        "passes through the "
                        "holes. Close them, or leave them if they are meant.",
                        list_of(names), edges)};
    }
    for (const Light& light : scene.lights) {
        const auto surface = lights::emitting_object(light);
        if (!surface || components[index_of(*surface)].turned_edges == 0) continue;
        warnings.push_back(fmt::format(
            "light \"{}\": at {} edges of object \"{}\" the front changes sides, but only fronts emit light. "
            "Turn "
            "its triangles to one side.",
            light.name, components[index_of(*surface)].turned_edges, scene.object(*surface).name));
    }
    return warnings;
}

}  // namespace stilb::checks
