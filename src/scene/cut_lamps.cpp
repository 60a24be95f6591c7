#include "scene/cut_lamps.h"

#include <utility>

#include "geometry/mesh_part.h"
#include "geometry/repeated_faces.h"

namespace stilb::scene {
namespace {

Object part_of(const Object& object, std::span<const std::uint32_t> triangles) {
    Object part{object.name, geometry::part_of(*geometry::MeshInWorld(object.shape), triangles),
                object.materials};
    if (object.materials.size() > 1) {
        std::vector<MaterialId> materials;
        for (const std::uint32_t t : triangles) materials.push_back(object.materials[t]);
        part.materials = std::move(materials);
    }
    return part;
}

void append(Mesh& mesh, const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace

ObjectId cut_out(Scene& scene, ObjectId object, std::span<const std::uint32_t> triangles, std::string name) {
    Object& whole = scene.objects[index_of(object)];
    Object lamp = part_of(whole, triangles);
    lamp.name = std::move(name);
    lamp.cut_from = object;
    whole = part_of(whole, geometry::others(geometry::stored_mesh(whole.shape)->triangles.size(), triangles));
    scene.objects.push_back(std::move(lamp));
    return ObjectId{static_cast<std::uint32_t>(scene.objects.size() - 1)};
}

std::size_t remove_repeated_faces(Object& lamp) {
    const Mesh* const mesh = geometry::stored_mesh(lamp.shape);
    if (mesh == nullptr) return 0;
    std::vector<std::uint32_t> repeated;
    for (const geometry::RepeatedFace& face : geometry::repeated_faces(*mesh))
        repeated.push_back(face.triangle);
    if (repeated.empty()) return 0;
    const auto cut_from = lamp.cut_from;
    lamp = part_of(lamp, geometry::others(mesh->triangles.size(), repeated));
    lamp.cut_from = cut_from;
    return repeated.size();
}

std::vector<ObjectId> cut_from(const Scene& scene, ObjectId object) {
    std::vector<ObjectId> lamps;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (scene.objects[i].cut_from == object) lamps.push_back(ObjectId{i});
    }
    return lamps;
}

Mesh whole_mesh(const Scene& scene, ObjectId object) {
    Mesh whole;
    append(whole, std::get<Mesh>(scene.object(object).shape));
    for (const ObjectId lamp : cut_from(scene, object))
        append(whole, std::get<Mesh>(scene.object(lamp).shape));
    return whole;
}

}  // namespace stilb::scene
