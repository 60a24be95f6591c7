// Objects of shape "mesh", and other meshes from files.
#include "io/scene/mesh_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/mesh/mesh_file.h"
#include "io/scene/sections.h"
#include "io/text/text.h"
#include "scene/instances.h"

namespace stilb::io {
namespace {

using Names = std::vector<std::string_view>;

Names names_of(const std::vector<NamedMaterial>& materials) {
    Names names;
    for (const NamedMaterial& material : materials) names.push_back(material.name);
    return names;
}

}  // namespace

MaterialId read_material(const TomlItem& item, const Scene& scene) {
    return MaterialId{static_cast<std::uint32_t>(item.index_in(names_of(scene.materials), "material"))};
}

void add_mesh_warnings(const std::string& where, const MeshFile& mesh, SceneFile& file) {
    for (const std::string& sentence : mesh_warnings(mesh)) {
        std::string warning = fmt::format("{}: {}", where, sentence);
        // Bodies of several luminaires have the same.
        if (std::ranges::find(file.warnings, Warning(warning)) == file.warnings.end())
            file.warnings.push_back(std::move(warning));
    }
}

namespace {

MeshFile read_mesh(const TomlItem& item, const std::filesystem::path& directory, SceneFile& file,
                   const Monitor& monitor) {
    const std::filesystem::path path = item.existing_file(directory);
    MeshFile mesh = read_mesh_file(path, monitor);
    mesh.other_files.insert(mesh.other_files.begin(), path);
    for (const std::filesystem::path& source : mesh.other_files)
        if (std::ranges::find(file.sources, source) == file.sources.end()) file.sources.push_back(source);
    return mesh;
}

/// The assignment of the scene's materials to the parts of a mesh, by the names in the mesh file.
class PartMaterials {
  public:
    PartMaterials(const TomlTable& object, const MeshParts& mesh, const Scene& scene)
        : mesh_(mesh), of_material_(mesh.material_names.size()), of_group_(mesh.group_names.size()) {
        if (const auto rest = object.find("material")) rest_ = read_material(*rest, scene);
        for (const auto& [part, item] : object.at("materials").table().items()) {
            const MaterialId material = read_material(item, scene);
            const bool is_material = assign(mesh.material_names, of_material_, part, material);
            if (!is_material && !assign(mesh.group_names, of_group_, part, material))
                fail_unknown(part, item);
        }
    }

    /// One material for each triangle. The file's material names take precedence over its groups, and both
    /// over `material`.
    std::vector<MaterialId> of_triangles(const TomlTable& object) const {
        std::vector<MaterialId> materials;
        materials.reserve(mesh_.material_of_triangle.size());
        for (std::size_t t = 0; t < mesh_.material_of_triangle.size(); ++t) {
            const std::uint32_t material = mesh_.material_of_triangle[t];
            const std::uint32_t group = mesh_.group_of_triangle[t];
            const auto& by_group = of_group_[group] ? of_group_[group] : rest_;
            const auto& found = of_material_[material] ? of_material_[material] : by_group;
            if (!found) fail_unassigned(object, material);
            materials.push_back(*found);
        }
        return materials;
    }

  private:
    using Assigned = std::vector<std::optional<MaterialId>>;

    static bool assign(const std::vector<std::string>& names, Assigned& assigned, std::string_view part,
                       MaterialId material) {
        const auto found = std::find(names.begin(), names.end(), part);
        if (found == names.end()) return false;
        assigned[static_cast<std::size_t>(found - names.begin())] = material;
        return true;
    }

    Names names() const {
        Names names(mesh_.material_names.begin(), mesh_.material_names.end());
        names.insert(names.end(), mesh_.group_names.begin(), mesh_.group_names.end());
        return names;
    }

    [[noreturn]] void fail_unknown(const std::string& part, const TomlItem& item) const {
        item.fail(fmt::format("the mesh file has no material or group {}.{}", in_quotes(part),
                              suggestion(part, names())));
    }

    [[noreturn]] void fail_unassigned(const TomlTable& object, std::uint32_t material) const {
        object.fail(fmt::format(
            "the mesh file's material {} is not assigned to a material of the scene. Allowed: an entry in "
            "\"materials\" for it, or \"material\" for all parts that are not in \"materials\".",
            in_quotes(mesh_.material_names[material])));
    }

    const MeshParts& mesh_;
    Assigned of_material_, of_group_;
    std::optional<MaterialId> rest_;
};

std::vector<MaterialId> read_materials_of(const TomlTable& table, const MeshParts& mesh, const Scene& scene) {
    if (table.has("materials")) return PartMaterials(table, mesh, scene).of_triangles(table);
    return {read_material(table.at("material"), scene)};
}

/// The materials of the scene that have the names in the mesh file.
std::vector<MaterialId> materials_by_name(const TomlItem& item, const MeshParts& mesh, const Scene& scene) {
    const Names known = names_of(scene.materials);
    std::vector<MaterialId> of_names;
    for (const std::string& name : mesh.material_names) {
        const auto found = std::ranges::find(known, name);
        if (found == known.end()) {
            item.fail(fmt::format(
                "the scene has no material {}, which the mesh file names.{} Or give the body materials: "
                "geometry = {{ file = ..., material = ... }}.",
                in_quotes(name), suggestion(name, known)));
        }
        of_names.push_back(MaterialId{static_cast<std::uint32_t>(found - known.begin())});
    }
    std::vector<MaterialId> of_triangles;
    for (const std::uint32_t material : mesh.material_of_triangle) of_triangles.push_back(of_names[material]);
    return of_triangles;
}

std::filesystem::path path_of(const TomlItem& item, const std::filesystem::path& directory) {
    return (directory / item.text()).lexically_normal();
}

}  // namespace

MeshFiles::MeshFiles(const std::vector<NamedTable>& objects, const std::filesystem::path& directory,
                     SceneFile& file, const Monitor& monitor)
    : directory_(directory), file_(file), monitor_(monitor) {
    for (const auto& [name, table] : objects) {
        const auto mesh = table.find("file");
        if (table.text_of("shape") == "mesh" && mesh && mesh->is_text()) ++uses_[path_of(*mesh, directory)];
    }
}

MeshFiles::Loaded& MeshFiles::load(const TomlTable& table) {
    const TomlItem item = table.at("file");
    const auto [found, is_new] = loaded_.try_emplace(path_of(item, directory_));
    Loaded& loaded = found->second;
    if (!is_new) return loaded;
    MeshFile mesh = read_mesh(item, directory_, file_, monitor_);
    add_mesh_warnings(table.where(), mesh, file_);
    loaded.mesh = std::make_shared<Mesh>(std::move(mesh.mesh));
    loaded.parts = take_parts(mesh);
    return loaded;
}

Object MeshFiles::read(const TomlTable& table, MeshParts& parts) {
    Loaded& loaded = load(table);
    parts = loaded.parts;
    SharedList<MaterialId> materials = read_materials_of(table, loaded.parts, file_.scene);
    if (materials == loaded.materials) materials = loaded.materials;  // one list for all
    loaded.materials = materials;
    const std::size_t uses = uses_.at(path_of(table.at("file"), directory_));
    if (scene::are_instances(loaded.mesh->triangles.size(), uses))
        return {"", Instance{loaded.mesh, {}}, std::move(materials)};
    if (uses == 1) return {"", std::move(*loaded.mesh), std::move(materials)};
    return {"", *loaded.mesh, std::move(materials)};
}

Object read_body(const TomlItem& item, const std::filesystem::path& directory, SceneFile& file) {
    const auto read = [&](const TomlItem& name) {
        MeshFile mesh = read_mesh(name, directory, file, Monitor::none());
        add_mesh_warnings(item.where(), mesh, file);
        return mesh;
    };
    if (!item.is_table()) {
        MeshFile mesh = read(item);
        std::vector<MaterialId> materials = materials_by_name(item, take_parts(mesh), file.scene);
        return {"", std::move(mesh.mesh), std::move(materials)};
    }
    TomlTable table = item.table();
    table.expect_keys({"file", "material", "materials", "scale", "rotate", "translate", "transform"});
    const bool is_by_name = !table.has("material") && !table.has("materials");
    MeshFile mesh = read(table.at("file"));
    const MeshParts parts = take_parts(mesh);
    std::vector<MaterialId> materials =
        is_by_name ? materials_by_name(item, parts, file.scene) : read_materials_of(table, parts, file.scene);
    return {"", transformed(std::move(mesh.mesh), read_transform(table)), std::move(materials)};
}

}  // namespace stilb::io
