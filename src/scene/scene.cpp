#include "scene/scene.h"

#include <numbers>

namespace stilb::scene {

Rgb flux_lm(const Scene& scene, const Light& light) {
    constexpr double pi = std::numbers::pi;
    struct Flux {
        const Scene& scene;
        Rgb operator()(const PointLight& l) const { return 4 * pi * l.intensity_cd; }
        Rgb operator()(const Luminaire& l) const { return scene.solid(l.solid).flux_lm() * l.factor; }
        Rgb operator()(const AreaLight& l) const {
            return pi * area_m2(scene.object(l.object).shape) * l.luminance_cd_m2;
        }
    };
    return std::visit(Flux{scene}, light.source);
}

double surface_area_m2(const Scene& scene) {
    double area = 0;
    for (const Object& object : scene.objects) area += area_m2(object.shape);
    return area;
}

}  // namespace stilb::scene
