#include "scene/sealed_sides.h"

#include <algorithm>
#include <optional>

#include "geometry/bounds_tree.h"
#include "geometry/mesh_topology.h"
#include "materials/material.h"

namespace stilb::scene {
namespace {

bool is_opaque(const Scene& scene, const Object& object) {
    return std::ranges::none_of(object.materials,
                                [&](MaterialId id) { return transmits(scene.material(id)); });
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

/// The bounds of the lights that have a place, and their objects, if any.
struct PlacedLights {
    std::vector<Bounds> bounds;
    std::vector<std::optional<ObjectId>> objects;

    explicit PlacedLights(const Scene& scene) {
        for (const Light& light : scene.lights) {
            const auto surface = lights::emitting_object(light);
            if (const auto origin = lights::point_origin(light)) {
                bounds.push_back({origin->position, origin->position});
            } else if (surface) {
                bounds.push_back(bounds_of(scene.object(*surface).shape));
            } else {
                continue;
            }
            objects.push_back(surface);
        }
    }
};

}  // namespace

std::vector<bool> sealed_sides(const Scene& scene) {
    std::vector<bool> is_sealed(2 * scene.objects.size());
    const PlacedLights lamps(scene);
    const geometry::BoundsTree tree(lamps.bounds);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const auto inside = inside_is_front(object.shape);
        if (!inside || !is_opaque(scene, object)) continue;
        const bool contains_light = tree.any_meeting(bounds_of(object.shape), [&](std::uint32_t lamp) {
            return lamps.objects[lamp] != ObjectId{i} || *inside;
        });
        if (!contains_light) is_sealed[ObjectSide{ObjectId{i}, *inside}.number()] = true;
    }
    return is_sealed;
}

}  // namespace stilb::scene
