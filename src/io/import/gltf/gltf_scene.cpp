#include "io/import/gltf/gltf_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "io/import/gltf/gltf_lights.h"
#include "io/import/gltf/gltf_materials.h"
#include "io/import/gltf/gltf_nodes.h"
#include "io/import/imported_scene.h"
#include "io/text/text.h"

namespace stilb::io {
namespace {

/// Extensions that are read, and those that change nothing here.
constexpr std::array<std::string_view, 11> kKnownExtensions{
    "KHR_lights_punctual",        "EXT_lights_ies",       "KHR_mesh_quantization",
    "KHR_texture_transform",      "KHR_materials_ior",    "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_emissive_strength",
    "KHR_materials_unlit",        "KHR_xmp_json_ld"};

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
                    const std::map<int, MaterialId>& materials) {
    ImportedMesh whole;
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
        whole.materials.resize(whole.mesh.triangles.size(), material->second);
    }
    return whole;
}

void add_objects(const gltf::File& file, const std::vector<gltf::PlacedNode>& nodes,
                 const std::vector<gltf::PlacedPrimitive>& primitives,
                 const std::map<int, MaterialId>& materials, ImportedScene& scene) {
    std::vector<std::vector<const gltf::PlacedPrimitive*>> of_node(nodes.size());
    for (const gltf::PlacedPrimitive& primitive : primitives) of_node[primitive.node].push_back(&primitive);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (of_node[n].empty()) continue;
        ImportedMesh mesh = joined(of_node[n], materials);
        if (mesh.materials.empty()) continue;
        const tinygltf::Node& node = *nodes[n].node;
        const std::string& of_mesh = file.model.meshes[static_cast<std::size_t>(node.mesh)].name;
        scene.add_object(node.name.empty() ? of_mesh : node.name, std::move(mesh));
    }
}

}  // namespace

SceneFile read_gltf_scene(std::string_view content, const std::filesystem::path& path,
                          const ImportSettings& settings) {
    gltf::File file = gltf::parse(content, path);
    ImportedScene scene(path);
    check_extensions(file, scene);
    const ImportOptions& options = settings.options();
    const std::vector<gltf::PlacedNode> nodes =
        placed_nodes(file, to_metres_and_z_up(options.scale.value_or(1), options.up.value_or(UpAxis::y)));
    {
        const std::vector<gltf::PlacedPrimitive> primitives = placed_primitives(file, nodes, scene.warnings);
        const std::map<int, MaterialId> materials = add_materials(file, primitives, scene);
        add_objects(file, nodes, primitives, materials, scene);
    }
    add_lights(file, nodes, scene);
    add_cameras(file, nodes, scene);
    auto& sources = scene.file.sources;
    sources.insert(sources.end(), file.sources.begin(), file.sources.end());
    return std::move(scene).finish(settings);
}

SceneFile read_gltf_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
    return read_gltf_scene(read_whole_file(path), path, ImportSettings(overrides, path.string()));
}

}  // namespace stilb::io
