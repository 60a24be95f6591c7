#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "checks/checks.h"
#include "scene/cut_lamps.h"

namespace stilb::checks {

SceneFindings::SceneFindings(const Scene& scene) {
    std::map<const Mesh*, std::size_t> first_of_mesh;  // instances share the components of their mesh
    for (const Object& object : scene.objects) {
        const auto* instance = std::get_if<Instance>(&object.shape);
        const auto first = first_of_mesh.find(instance == nullptr ? nullptr : instance->mesh.get());
        if (instance != nullptr) first_of_mesh.try_emplace(instance->mesh.get(), components.size());
        components.push_back(first == first_of_mesh.end() ? find_components(object.shape)
                                                          : components[first->second]);
    }
    join_cut_lamps(scene);
    units = unit_warnings(scene);
    holes = hole_warnings(scene, components);
    overlaps = scene::find_overlaps(scene, scene::OverlapsOf::all_surfaces, kMostOverlaps);
}

void SceneFindings::join_cut_lamps(const Scene& scene) {
    std::set<ObjectId> with_lamps;
    for (const Object& object : scene.objects) {
        if (object.cut_from) with_lamps.insert(*object.cut_from);
    }
    for (const ObjectId object : with_lamps) {
        geometry::ConnectedComponents& own = components[index_of(object)];
        geometry::ConnectedComponents whole = find_components(scene::whole_mesh(scene, object));
        auto first = whole.of_triangle.begin();
        const auto take = [&](std::size_t count) {
            const auto begin = std::exchange(first, first + static_cast<std::ptrdiff_t>(count));
            return std::vector<std::uint32_t>(begin, first);
        };
        own.of_triangle = take(own.of_triangle.size());
        // Components are numbered by their first triangles: those of lamps alone come last.
        const std::uint32_t last = *std::ranges::max_element(own.of_triangle);
        own.open_edges.assign(whole.open_edges.begin(), whole.open_edges.begin() + last + 1);
        for (const ObjectId lamp : scene::cut_from(scene, object))
            cut_lamps[lamp] = {object, take(components[index_of(lamp)].of_triangle.size())};
    }
}

}  // namespace stilb::checks
