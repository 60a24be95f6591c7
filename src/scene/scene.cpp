#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace stilb::scene {

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Bounds LightSurroundings::bounds() const { return bounds_of(scene_); }

Bounds bounds_of(const Scene& scene) {
    Bounds all;
    for (const Object& object : scene.objects) {
        const Bounds own = geometry::bounds_of(object.shape);
        if (own.is_empty()) continue;
        all.include(own.min), all.include(own.max);
    }
    for (const Light& light : scene.lights) {
        if (const auto origin = lights::point_origin(light)) all.include(origin->position);
    }
    return all.is_empty() ? Bounds{{}, {}} : all;
}

std::set<MaterialId> materials_of(const Scene& scene, const Object& object) {
    std::set<MaterialId> all(object.materials.begin(), object.materials.end());
    const std::set<MaterialId> fronts = all;
    for (const MaterialId front : fronts) all.insert(scene.on_side(front, false));
    return all;
}

bool have_backs(const Scene& scene) {
    return std::ranges::any_of(scene.materials,
                               [](const NamedMaterial& named) { return named.back.has_value(); });
}

std::set<ObjectId> lamps_of(const Scene& scene) {
    std::set<ObjectId> lamps;
    for (const Light& light : scene.lights) {
        if (const auto object = lights::emitting_object(light)) lamps.insert(*object);
    }
    return lamps;
}

std::optional<Vec3> place_of(const Scene& scene, const Light& light) {
    if (const Luminaire* luminaire = lights::luminaire_of(light)) return luminaire->position;
    if (const auto origin = lights::point_origin(light)) return origin->position;
    if (const auto object = lights::emitting_object(light))
        return bounds_of(scene.object(*object).shape).middle();
    return std::nullopt;
}

Rgb flux_lm(const Scene& scene, const Light& light) {
    return lights::flux_lm(light, LightSurroundings(scene));
}

std::optional<std::array<double, 2>> maintenance_factors(const Scene& scene) {
    std::optional<std::array<double, 2>> range;
    for (const Light& light : scene.lights) {
        if (location_of(light) == LightLocation::infinity) continue;  // daylight is no lamp
        if (!range) range = {light.maintenance, light.maintenance};
        range = {std::min((*range)[0], light.maintenance), std::max((*range)[1], light.maintenance)};
    }
    return range && (*range)[0] < 1 ? range : std::nullopt;
}

double surface_area_m2(const Scene& scene) {
    double area = 0;
    for (const Object& object : scene.objects) area += area_m2(object.shape);
    return area;
}

}  // namespace stilb::scene
