#include "run/possible_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transport/line_of_sight.h"

namespace stilb::run {
namespace {

/// The height of the box's highest corner above a surface element.
double height_above(const MeasuringPoint& at, const Bounds& box) {
    const Vec3 half = 0.5 * (box.max - box.min), &n = at.normal;
    return dot(box.middle() - at.position, n) + std::abs(n.x) * half.x + std::abs(n.y) * half.y +
           std::abs(n.z) * half.z;
}

}  // namespace

PossibleLight::PossibleLight(const Scene& scene, const rays::RayCaster& caster, int max_reflections)
    : caster_(caster), lights_(scene, caster) {
    if (max_reflections == 0) return;
    for (const Object& object : scene.objects) {
        const bool reflects = std::ranges::any_of(object.materials, [&](MaterialId material) {
            return reflectance_bound(scene.material(material)).max() > 0;
        });
        if (reflects) reflecting_.push_back(bounds_of(object.shape));
    }
}

double PossibleLight::of(const Measurand& measurand) const {
    if (reflecting_.empty()) return 0;
    if (const auto* point = std::get_if<MeasuringPoint>(&measurand)) return light_lx(*point);
    if (const auto* body = std::get_if<BodyPoint>(&measurand))
        return light_lx({body->position, body->axis}) + light_lx({body->position, -body->axis});
    const auto surface = transport::first_surface(measurand, caster_);
    return surface ? light_lx({surface->position, surface->normal}) / std::numbers::pi : 0;
}

double PossibleLight::light_lx(const MeasuringPoint& at) const {
    const double lift_m = caster_.offset_m(at.position, caster_.lift().largest_size_m());
    const auto is_above = [&](const Bounds& box) { return height_above(at, box) > 2 * lift_m; };
    if (std::ranges::none_of(reflecting_, is_above)) return 0;
    double sum_lx = 0;
    for (std::size_t light = 0; light < lights_.count(); ++light)
        sum_lx += lights_.rough_illuminance_lx(light, at.position, at.normal);
    return sum_lx;
}

}  // namespace stilb::run
