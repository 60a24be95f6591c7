// Materials and objects as tables of a scene file.
#include "io/import/scene_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "io/mesh/mesh_file.h"
#include "io/scene/toml_text.h"
#include "io/text/text.h"
#include "materials/model_list.h"
#include "scene/cut_lamps.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

struct MaterialTable {
    template <typename Model>
    TomlMembers operator()(const Model& model) const {
        TomlMembers members{{"type", 0, toml_text(std::string(Model::kType))}};
        const auto& parameters = materials::parameters_of(model);
        for_each_field<materials::ParametersOf<Model>>([&](const auto& field) {
            const auto& value = parameters.*field.member;
            if (materials::is_given(value)) members.push_back({std::string(field.key), 0, toml_value(value)});
        });
        return members;
    }
};

const std::string& material_name(const Scene& scene, MaterialId material) {
    return scene.materials[index_of(material)].name;
}

/// An object and the lamps that were cut out of it, as one mesh with a name for each part.
struct NamedParts {
    Mesh mesh;
    std::vector<std::uint32_t> part_of_triangle;
    std::vector<std::string> names;
    TomlMembers materials;  ///< the material of each name

    std::uint32_t part(const std::string& name, const std::string& material) {
        const auto found = std::ranges::find(names, name);
        const auto index = static_cast<std::uint32_t>(found - names.begin());
        if (found == names.end()) {
            names.push_back(name);
            materials.push_back({name, 0, toml_text(material)});
        }
        return index;
    }
};

/// Appends with normals: those of a mesh without them are missing.
void append_mesh(Mesh& whole, const Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(whole.vertices.size());
    const auto first_normal = static_cast<std::uint32_t>(whole.normals.size());
    whole.vertices.insert(whole.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    whole.normals.insert(whole.normals.end(), mesh.normals.begin(), mesh.normals.end());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        whole.triangles.push_back({first + a, first + b, first + c});
        Triangle normals = mesh.corner_normals.empty() ? mesh.triangles[t] : mesh.corner_normals[t];
        for (std::uint32_t& normal : normals)
            normal = mesh.normals.empty() || normal == kNoNormal ? kNoNormal : first_normal + normal;
        whole.corner_normals.push_back(normals);
    }
}

NamedParts named_parts(const Scene& scene, ObjectId id) {
    NamedParts parts;
    const auto add = [&](ObjectId part, const std::string& fixed_name) {
        const Object& object = scene.object(part);
        const Mesh& mesh = *geometry::stored_mesh(object.shape);
        append_mesh(parts.mesh, mesh);
        while (parts.part_of_triangle.size() < parts.mesh.triangles.size()) {
            const std::size_t t =
                mesh.triangles.size() - (parts.mesh.triangles.size() - parts.part_of_triangle.size());
            const std::string& material =
                material_name(scene, object.materials[object.materials.size() == 1 ? 0 : t]);
            parts.part_of_triangle.push_back(
                parts.part(fixed_name.empty() ? material : fixed_name, material));
        }
    };
    add(id, "");
    for (const ObjectId lamp : scene::cut_from(scene, id)) add(lamp, part_name(scene, lamp));
    return parts;
}

/// The tables of meshes that were written for an instance, by mesh and materials.
using SharedTables = std::map<std::pair<const Mesh*, const MaterialId*>, TomlMembers>;

class ObjectTable {
  public:
    ObjectTable(const Scene& scene, ObjectId id, SceneOutput& output, SharedTables& shared)
        : scene_(scene), id_(id), object_(scene.object(id)), output_(output), shared_(shared) {}

    TomlMembers operator()(const Mesh& mesh) const {
        const bool is_plain =
            object_.materials.size() == 1 && mesh.normals.empty() && scene::cut_from(scene_, id_).empty();
        if (is_plain) {
            const std::string file = output_.write(object_.name, ".ply", to_ply(mesh, PlyNumbers::float64));
            return with_material({{"shape", 0, toml_text("mesh")}, {"file", 0, toml_text(file)}});
        }
        NamedParts parts = named_parts(scene_, id_);
        const std::string file =
            output_.write(object_.name, ".obj", to_obj(parts.mesh, parts.part_of_triangle, parts.names));
        return {{"shape", 0, toml_text("mesh")},
                {"file", 0, toml_text(file)},
                {"materials", 0, {std::move(parts.materials)}}};
    }
    /// Instances with the same materials have the same file.
    TomlMembers operator()(const Instance& instance) const {
        const auto [known, is_new] = shared_.try_emplace({instance.mesh.get(), object_.materials.data()});
        if (is_new) known->second = (*this)(*instance.mesh);
        TomlMembers members = known->second;
        const auto& [x, y, z, t] = instance.to_world;
        TomlArray rows;
        for (const double entry :
             {x.x, y.x, z.x, t.x, x.y, y.y, z.y, t.y, x.z, y.z, z.z, t.z, 0., 0., 0., 1.})
            rows.push_back(toml_number(entry));
        members.push_back({"transform", 0, {std::move(rows)}});
        return members;
    }
    TomlMembers operator()(const Rectangle& r) const {
        return with_material({{"shape", 0, toml_text("rectangle")},
                              {"corner", 0, toml_vector(r.corner)},
                              {"edge_u", 0, toml_vector(r.edge_u)},
                              {"edge_v", 0, toml_vector(r.edge_v)}});
    }
    TomlMembers operator()(const Box& box) const {
        return with_material({{"shape", 0, toml_text("box")},
                              {"min", 0, toml_vector(box.min)},
                              {"max", 0, toml_vector(box.max)}});
    }
    TomlMembers operator()(const Sphere& sphere) const {
        return with_material({{"shape", 0, toml_text("sphere")},
                              {"center", 0, toml_vector(sphere.center)},
                              {"radius", 0, toml_number(sphere.radius)}});
    }
    TomlMembers operator()(const Disk& disk) const {
        return with_material({{"shape", 0, toml_text("disk")},
                              {"center", 0, toml_vector(disk.center)},
                              {"normal", 0, toml_vector(disk.normal)},
                              {"radius", 0, toml_number(disk.radius)}});
    }
    TomlMembers operator()(const Harmonics&) const {
        throw InputError(fmt::format("object {} is a surface by harmonics, which only scenes in TOML have.",
                                     in_quotes(object_.name)));
    }

  private:
    TomlMembers with_material(TomlMembers members) const {
        members.push_back({"material", 0, toml_text(material_name(scene_, object_.materials.front()))});
        return members;
    }

    const Scene& scene_;
    ObjectId id_;
    const Object& object_;
    SceneOutput& output_;
    SharedTables& shared_;
};

/// The openings of luminaires come with their lights.
bool is_opening(const Scene& scene, ObjectId id) {
    return std::ranges::any_of(scene.lights,
                               [&](const Light& light) { return lights::opening_of(light) == id; });
}

bool is_written(const Scene& scene, ObjectId id) {
    return !scene.object(id).cut_from && !is_opening(scene, id);
}

}  // namespace

std::string part_name(const Scene& scene, ObjectId lamp) {
    const Object& object = scene.object(lamp);
    const auto lamps = scene::cut_from(scene, *object.cut_from);
    const auto number = std::ranges::find(lamps, lamp) - lamps.begin() + 1;
    return fmt::format("{} (lamp {})", material_name(scene, object.materials.front()), number);
}

TomlMembers material_tables(const Scene& scene) {
    std::set<MaterialId> used;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (!is_opening(scene, ObjectId{i}))
            used.insert(scene.objects[i].materials.begin(), scene.objects[i].materials.end());
    }
    TomlMembers tables;
    for (const MaterialId id : used) {
        const NamedMaterial& material = scene.materials[index_of(id)];
        tables.push_back({material.name, 0, {materials::visit_model(MaterialTable{}, material.material)}});
    }
    return tables;
}

TomlMembers object_tables(const Scene& scene, SceneOutput& output) {
    TomlMembers tables;
    SharedTables shared;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const ObjectId id{i};
        if (!is_written(scene, id)) continue;
        const Object& object = scene.object(id);
        tables.push_back(
            {object.name, 0, {std::visit(ObjectTable(scene, id, output, shared), object.shape)}});
    }
    return tables;
}

}  // namespace stilb::io
