#include "io/import/gltf/gltf_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "geometry/leaning_normals.h"
#include "io/import/gltf/gltf_lights.h"
#include "io/import/gltf/gltf_materials.h"
#include "io/import/gltf/gltf_nodes.h"
#include "io/import/imported_scene.h"
#include "io/mesh/mesh_file.h"
#include "io/text/text.h"
#include "io/text/utf8.h"

namespace stilb::io {
namespace {

/// Extensions that are read, and those that change nothing here.
constexpr std::array<std::string_view, 12> kKnownExtensions{
    "KHR_lights_punctual",    "EXT_lights_ies",
    "KHR_mesh_quantization",  "EXT_mesh_gpu_instancing",
    "KHR_texture_transform",  "KHR_materials_ior",
    "KHR_materials_specular", "KHR_materials_transmission",
    "KHR_materials_volume",   "KHR_materials_emissive_strength",
    "KHR_materials_unlit",    "KHR_xmp_json_ld"};

bool is_known(const std::string& extension) {
    return std::ranges::find(kKnownExtensions, extension) != kKnownExtensions.end();
}

void check_extensions(const gltf::File& file, ImportedScene& scene) {
    for (const std::string& extension : file.model.extensionsRequired) {
        if (is_known(extension) || extension.starts_with("KHR_materials_")) continue;
        file.fail_for_extension(extension);
    }
    for (const std::string& extension : file.model.extensionsUsed) {
        if (!is_known(extension) && !extension.starts_with("KHR_materials_"))
            scene.warnings.add("extension", extension, "it is not read.");
    }
    if (!file.model.animations.empty()) scene.note("animations are left out.");
}

/// The primitives of one node as one mesh.
ImportedMesh joined(const std::vector<const gltf::PlacedPrimitive*>& primitives,
                    const std::map<int, gltf::SurfaceMaterial>& materials) {
    ImportedMesh whole;
    bool has_places = false;
    const bool has_normals = std::ranges::any_of(
        primitives, [](const gltf::PlacedPrimitive* p) { return !p->mesh.normals.empty(); });
    for (const gltf::PlacedPrimitive* primitive : primitives) {
        const auto material = materials.find(primitive->material);
        if (material == materials.end()) continue;
        const Mesh& mesh = primitive->mesh;
        const auto first = static_cast<std::uint32_t>(whole.mesh.vertices.size());
        whole.mesh.vertices.insert(whole.mesh.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        if (has_normals) {
            whole.mesh.normals.insert(whole.mesh.normals.end(), mesh.normals.begin(), mesh.normals.end());
            whole.mesh.normals.resize(whole.mesh.vertices.size());
        }
        for (const auto& [a, b, c] : mesh.triangles)
            whole.mesh.triangles.push_back({first + a, first + b, first + c});
        const auto& [id, texture] = material->second;
        whole.materials.resize(whole.mesh.triangles.size(), id);
        has_places = has_places || texture.has_value();
        whole.places.resize(whole.mesh.triangles.size(), no_place());
        for (std::size_t t = 0; texture && t < mesh.triangles.size(); ++t)
            whole.places[whole.places.size() - mesh.triangles.size() + t] = place_of(*primitive, t, *texture);
    }
    if (!has_places) whole.places.clear();
    return whole;
}

/// The objects of nodes.
class ObjectsOfNodes {
  public:
    ObjectsOfNodes(const gltf::File& file, const std::vector<gltf::PlacedNode>& nodes,
                   const gltf::PlacedMeshes& meshes, const std::map<int, gltf::SurfaceMaterial>& materials)
        : file_(file), nodes_(nodes), meshes_(meshes), materials_(materials), of_node_(nodes.size()) {
        for (const auto& primitive : meshes.primitives) of_node_[primitive.node].push_back(&primitive);
        for (const auto& [instance, first] : meshes.first_of_instance) shared_.try_emplace(first);
    }

    void add_to(ImportedScene& scene) && {
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            const auto instance = meshes_.first_of_instance.find(n);
            if (instance != meshes_.first_of_instance.end()) {
                const geometry::Transform from_first = nodes_[instance->second].to_world.inverse();
                add_instance(n, instance->second, compose(nodes_[n].to_world, from_first), scene);
            } else if (!of_node_[n].empty()) {
                add(n, scene);
            }
        }
    }

  private:
    const std::string& name_of(std::size_t n) const {
        const tinygltf::Node& node = *nodes_[n].node;
        return node.name.empty() ? file_.model.meshes[static_cast<std::size_t>(nodes_[n].mesh)].name
                                 : node.name;
    }

    void add(std::size_t n, ImportedScene& scene) {
        ImportedMesh mesh = joined(of_node_[n], materials_);
        if (mesh.materials.empty()) return;
        if (geometry::drop_leaning_normals(mesh.mesh) > 0)
            scene.warnings.add("node", name_of(n), leaning_warning("some triangles"));
        const auto shared = shared_.find(n);
        if (shared == shared_.end()) return scene.add_object(name_of(n), std::move(mesh));
        shared->second.emplace(std::move(mesh));
        add_instance(n, n, {}, scene);
    }

    void add_instance(std::size_t n, std::size_t first, const geometry::Transform& from_first,
                      ImportedScene& scene) const {
        const std::optional<SharedMesh>& shared = shared_.at(first);
        if (shared) scene.add_instance(name_of(n), *shared, from_first);
    }

    const gltf::File& file_;
    const std::vector<gltf::PlacedNode>& nodes_;
    const gltf::PlacedMeshes& meshes_;
    const std::map<int, gltf::SurfaceMaterial>& materials_;
    std::vector<std::vector<const gltf::PlacedPrimitive*>> of_node_;
    /// The meshes of nodes that have instances, where the node places them; nothing for invisible ones.
    std::map<std::size_t, std::optional<SharedMesh>> shared_;
};

}  // namespace

SceneFile read_gltf_scene(std::string_view content, const std::filesystem::path& path,
                          const ImportSettings& settings) {
    gltf::File file = gltf::parse(content, path);
    ImportedScene scene(path);
    check_extensions(file, scene);
    const ImportOptions& options = settings.options();
    const std::vector<gltf::PlacedNode> nodes = placed_nodes(file, options.to_world(UpAxis::y));
    {
        // A texture divides the surfaces of each node on its own.
        const auto repeats = options.textures ? gltf::Repeats::copies : gltf::Repeats::instances;
        const gltf::PlacedMeshes meshes = placed_meshes(file, nodes, repeats, scene.warnings);
        const auto materials = add_materials(file, meshes.primitives, options.textures, scene);
        ObjectsOfNodes(file, nodes, meshes, materials).add_to(scene);
    }
    add_lights(file, nodes, scene);
    add_cameras(file, nodes, scene);
    auto& sources = scene.file.sources;
    sources.insert(sources.end(), file.sources.begin(), file.sources.end());
    scene.settle_faces(settings);
    return std::move(scene).finish(settings);
}

SceneFile read_gltf_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
    return read_gltf_scene(read_text_file(path), path, ImportSettings(overrides, path.string()));
}

}  // namespace stilb::io
