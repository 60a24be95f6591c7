#include "scene/scene.h"

namespace stilb::scene {

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

Rgb flux_lm(const Scene& scene, const Light& light) {
    return lights::flux_lm(light, LightSurroundings(scene));
}

double surface_area_m2(const Scene& scene) {
    double area = 0;
    for (const Object& object : scene.objects) area += area_m2(object.shape);
    return area;
}

}  // namespace stilb::scene
