#include "run/possible_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transport/line_of_sight.h"

namespace stilb::run {
namespace {

/// Particles that find surfaces that reflect light, and estimates of lamps for them.
constexpr std::size_t kParticles = 128, kMostEstimates = 1'000'000;

/// The height of the box's highest corner above a surface element.
double height_above(const MeasuringPoint& at, const Bounds& box) {
    const Vec3 half = 0.5 * (box.max - box.min), &n = at.normal;
    return dot(box.middle() - at.position, n) + std::abs(n.x) * half.x + std::abs(n.y) * half.y +
           std::abs(n.z) * half.z;
}

}  // namespace

PossibleLight::PossibleLight(const Scene& scene, const rays::RayCaster& caster, int max_reflections)
    : scene_(scene), caster_(caster), lights_(scene, caster) {
    if (max_reflections == 0) return;
    for (const Object& object : scene.objects) {
        const bool reflects = std::ranges::any_of(object.materials, [&](MaterialId material) {
            return reflectance_bound(scene.material(material)).max() > 0;
        });
        if (reflects) reflecting_.push_back(bounds_of(object.shape));
    }
    if (!reflecting_.empty() && lights_.count() > 0) find_lit();
}

void PossibleLight::find_lit() {
    const std::size_t particles = std::clamp<std::size_t>(kMostEstimates / lights_.count(), 1, kParticles);
    for (std::size_t i = 0; i < particles; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const transport::EmittedParticle particle = lights_.sample_emission(stream);
        const auto hit = caster_.closest(particle.origin, particle.direction);
        if (!hit) continue;
        const double reflectance = reflectance_bound(scene_.material(hit->material)).luminance();
        const double lx = all_lx(hit->position, hit->normal);
        if (reflectance > 0 && lx > 0) lit_.push_back({hit->lifted, hit->normal, reflectance, lx});
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

double PossibleLight::seen_lx(const MeasuringPoint& at, const Vec3& lifted) const {
    // Particles carry about equal light, so that each stands for an area of 1 / illuminance.
    double light = 0, area = 0;
    for (const Lit& lit : lit_) {
        const Vec3 offset = lit.lifted - lifted;
        const double along = -dot(offset, lit.normal), above = dot(offset, at.normal);
        if (along <= 0 || above <= 0) continue;
        if (!(caster_.transmittance({lifted, lit.lifted}).max() > 0)) continue;
        const double squared = squared_length(offset), seen = along * above / (squared * squared);
        light += seen * lit.reflectance;
        area += seen / lit.all_lx;
    }
    return area > 0 ? light / area : 0;
}

double PossibleLight::all_lx(const Vec3& position, const Vec3& normal) const {
    double sum_lx = 0;
    for (std::size_t light = 0; light < lights_.count(); ++light)
        sum_lx += lights_.rough_illuminance_lx(light, position, normal);
    return sum_lx;
}

double PossibleLight::light_lx(const MeasuringPoint& at) const {
    const double lift_m = caster_.offset_m(at.position, caster_.lift().largest_size_m());
    const auto is_above = [&](const Bounds& box) { return height_above(at, box) > 2 * lift_m; };
    if (std::ranges::none_of(reflecting_, is_above)) return 0;
    return std::max(all_lx(at.position, at.normal), seen_lx(at, at.position + lift_m * at.normal));
}

}  // namespace stilb::run
