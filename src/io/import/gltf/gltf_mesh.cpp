#include "io/import/gltf/gltf_mesh.h"

#include <utility>

#include "io/import/gltf/gltf_nodes.h"
#include "io/import/imported_scene.h"
#include "io/text/text.h"
#include "io/text/utf8.h"

namespace stilb::io {
namespace {

void add_primitive(gltf::PlacedPrimitive& primitive, MeshBuilder& builder) {
    Mesh& mesh = primitive.mesh;
    drop_flat_normals(mesh);
    const auto first = static_cast<std::uint32_t>(builder.vertex_count());
    const auto first_normal = static_cast<std::uint32_t>(builder.normal_count());
    for (const Vec3& vertex : mesh.vertices) builder.add_vertex(vertex);
    for (const Vec3& normal : mesh.normals) builder.add_normal(normal);
    for (const auto& [a, b, c] : mesh.triangles) {
        Triangle normals{kNoNormal, kNoNormal, kNoNormal};
        if (!mesh.normals.empty()) normals = {first_normal + a, first_normal + b, first_normal + c};
        builder.add_triangle({first + a, first + b, first + c}, normals);
    }
}

}  // namespace

MeshFile read_gltf_mesh(const std::filesystem::path& path) {
    const gltf::File file = gltf::parse(read_text_file(path), path);
    GroupedWarnings of_a_scene;  // a mesh has neither lines nor animations
    const auto nodes = placed_nodes(file, to_metres_and_z_up(1, UpAxis::y));
    MeshBuilder builder;
    for (gltf::PlacedPrimitive& primitive :
         placed_meshes(file, nodes, gltf::Repeats::copies, of_a_scene).primitives) {
        builder.use_group(nodes[primitive.node].node->name);
        const auto& materials = file.model.materials;
        const bool has_material =
            primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < materials.size();
        builder.use_material(has_material ? materials[static_cast<std::size_t>(primitive.material)].name
                                          : "");
        add_primitive(primitive, builder);
    }
    MeshFile mesh =
        std::move(builder).finish(path.string(), "a glTF file needs a node with a mesh of triangles");
    mesh.other_files = file.sources;
    return mesh;
}

}  // namespace stilb::io
