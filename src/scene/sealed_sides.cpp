#include "scene/sealed_sides.h"

#include <algorithm>
#include <optional>

#include "geometry/mesh_topology.h"

namespace stilb::scene {
namespace {

bool overlap(const Bounds& a, const Bounds& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
           a.min.z <= b.max.z && b.min.z <= a.max.z;
}

bool is_opaque(const Scene& scene, const Object& object) {
    return std::ranges::none_of(object.materials, [&](MaterialId id) {
        const Material& material = scene.material(id);
        return is_specular(material) && !std::holds_alternative<Mirror>(material);
    });
}

/// Six times the volume that a mesh encloses; negative where its fronts look inwards.
double signed_volume(const Mesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& origin = mesh.vertices[mesh.triangles[0][0]];
        sum += dot(mesh.vertices[a] - origin, cross(mesh.vertices[b] - origin, mesh.vertices[c] - origin));
    }
    return sum;
}

/// Whether the inside of a closed shape is its front; nothing for other shapes.
std::optional<bool> inside_is_front(const Shape& shape) {
    if (std::holds_alternative<Rectangle>(shape) || std::holds_alternative<Disk>(shape)) return std::nullopt;
    const Mesh* mesh = geometry::stored_mesh(shape);
    if (mesh == nullptr) return false;
    const geometry::ConnectedComponents components = geometry::find_components(*mesh);
    if (components.total_open_edges() > 0 || components.turned_edges > 0) return std::nullopt;
    return signed_volume(*mesh) < 0;
}

bool contains_light(const Scene& scene, ObjectId object) {
    const Bounds bounds = bounds_of(scene.object(object).shape);
    return std::ranges::any_of(scene.lights, [&](const Light& light) {
        if (const auto origin = lights::point_origin(light))
            return overlap(bounds, {origin->position, origin->position});
        const auto surface = lights::emitting_object(light);
        return surface && (*surface == object ? inside_is_front(scene.object(object).shape).value_or(true)
                                              : overlap(bounds, bounds_of(scene.object(*surface).shape)));
    });
}

}  // namespace

std::vector<bool> sealed_sides(const Scene& scene) {
    std::vector<bool> is_sealed(2 * scene.objects.size());
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const ObjectId object{i};
        const auto inside = inside_is_front(scene.objects[i].shape);
        if (inside && is_opaque(scene, scene.objects[i]) && !contains_light(scene, object))
            is_sealed[object_side(object, *inside)] = true;
    }
    return is_sealed;
}

}  // namespace stilb::scene
