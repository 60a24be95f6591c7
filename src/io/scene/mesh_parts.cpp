#include "io/scene/mesh_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "geometry/mesh_part.h"
#include "io/text/text.h"
#include "scene/cut_lamps.h"

namespace stilb::io {
namespace {

using Triangles = std::vector<std::uint32_t>;

template <typename IsWanted>
Triangles triangles_where(std::size_t count, const IsWanted& is_wanted) {
    Triangles triangles;
    for (std::uint32_t t = 0; t < count; ++t) {
        if (is_wanted(t)) triangles.push_back(t);
    }
    return triangles;
}

/// The triangles of a part of the file; nothing where it has no part of this name.
std::optional<Triangles> triangles_of_part(std::string_view part, const std::vector<std::string>& names,
                                           const SharedList<std::uint32_t>& of_triangle) {
    const auto found = std::ranges::find(names, part);
    if (found == names.end()) return std::nullopt;
    const auto index = static_cast<std::uint32_t>(found - names.begin());
    return triangles_where(of_triangle.size(), [&](std::uint32_t t) { return of_triangle[t] == index; });
}

/// The triangles that have a material of the scene; nothing where none has one of this name.
std::optional<Triangles> triangles_of_material(std::string_view name, const Object& object,
                                               const Scene& scene) {
    const auto& materials = object.materials;
    const auto count = geometry::stored_mesh(object.shape)->triangles.size();
    Triangles triangles = triangles_where(count, [&](std::uint32_t t) {
        return scene.materials[index_of(materials[materials.size() == 1 ? 0 : t])].name == name;
    });
    return triangles.empty() ? std::nullopt : std::optional(std::move(triangles));
}

/// The names that the key may have, without those of unnamed parts.
std::vector<std::string_view> allowed_names(std::string_view key, const Object& object,
                                            const MeshParts& parts, const Scene& scene) {
    std::vector<std::string_view> names;
    const auto add = [&](std::string_view name) {
        if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
    };
    for (const std::string& name : key == "material" ? parts.material_names : parts.group_names) add(name);
    if (key != "material") return names;
    for (const MaterialId material : object.materials) add(scene.materials[index_of(material)].name);
    return names;
}

std::string name_of_lamp(const Object& object, std::string_view part) {
    return fmt::format("{} ({})", object.name, part);
}

Triangles picked_triangles(const TomlTable::NamedItem& part, const Object& object, const MeshParts& parts,
                           const Scene& scene) {
    const auto& [key, item] = part;
    const std::string& name = item.text();
    auto picked = key == "material"
                      ? triangles_of_part(name, parts.material_names, parts.material_of_triangle)
                      : triangles_of_part(name, parts.group_names, parts.group_of_triangle);
    if (!picked && key == "material") picked = triangles_of_material(name, object, scene);
    const bool is_taken =
        std::ranges::find(scene.objects, name_of_lamp(object, name), &Object::name) != scene.objects.end();
    if (is_taken || (picked && picked->empty())) {
        item.fail(
            fmt::format("the faces of {} shine already, as another light. Allowed: one light for each face.",
                        in_quotes(name)));
    }
    if (!picked) {
        item.fail(fmt::format("the mesh {} has no {} {}.{}", in_quotes(object.name),
                              key == "material" ? "material" : "group", in_quotes(name),
                              suggestion(name, allowed_names(key, object, parts, scene))));
    }
    return std::move(*picked);
}

std::vector<std::uint32_t> elements(const SharedList<std::uint32_t>& all, const Triangles& numbers) {
    std::vector<std::uint32_t> some;
    for (const std::uint32_t number : numbers) some.push_back(all[number]);
    return some;
}

}  // namespace

MeshParts take_parts(MeshFile& file) {
    return {std::move(file.material_names), std::move(file.material_of_triangle), std::move(file.group_names),
            std::move(file.group_of_triangle)};
}

ObjectId cut_out_lamp(Scene& scene, ObjectId object, const TomlTable::NamedItem& part,
                      PartsOfObjects& parts) {
    const Object& whole = scene.object(object);
    const Mesh* mesh = geometry::stored_mesh(whole.shape);
    if (mesh == nullptr) {
        part.item.fail(
            fmt::format("picks faces of a mesh, but {} is none. Allowed: an object of shape \"mesh\" "
                        "or \"polygons\"; or leave this key out, and the whole object shines.",
                        in_quotes(whole.name)));
    }
    MeshParts& of_object = parts[object];
    const Triangles picked = picked_triangles(part, whole, of_object, scene);
    if (picked.size() == mesh->triangles.size()) return object;
    if (!of_object.material_of_triangle.empty()) {
        const Triangles rest = geometry::others(mesh->triangles.size(), picked);
        of_object.material_of_triangle = elements(of_object.material_of_triangle, rest);
        of_object.group_of_triangle = elements(of_object.group_of_triangle, rest);
    }
    return scene::cut_out(scene, object, picked, name_of_lamp(whole, part.item.text()));
}

}  // namespace stilb::io
