#include "run/readings/possible_light.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "statistics/interval.h"
#include "transport/line_of_sight.h"

namespace stilb::run {
namespace {

/// Particles that find surfaces that reflect light, and estimates of lamps for them.
constexpr std::size_t kParticles = 1024, kMostEstimates = 1'000'000;
/// Contributions that are larger than others by this factor are of another kind.
constexpr double kBrighter = 2;
/// None of so many expected samples comes with a probability of 2 %.
constexpr double kMayMiss = 4;
/// Standard errors of the particles' light by which it may be more.
constexpr double kUnsure = 2;

/// The height of the box's highest corner above a surface element.
double height_above(const SurfacePoint& at, const Bounds& box) {
    const Vec3 half = 0.5 * (box.max - box.min), &n = at.normal;
    return dot(box.middle() - at.position, n) + std::abs(n.x) * half.x + std::abs(n.y) * half.y +
           std::abs(n.z) * half.z;
}

}  // namespace

PossibleLight::PossibleLight(const Scene& scene, const rays::RayCaster& caster, int max_reflections,
                             const estimators::Estimator& estimator)
    : scene_(scene), caster_(caster), lights_(scene, caster) {
    if (max_reflections == 0) return;
    for (const Object& object : scene.objects) {
        const bool reflects = std::ranges::any_of(materials_of(scene, object), [&](MaterialId material) {
            return reflectance_bound(scene.material(material)).max() > 0;
        });
        if (reflects) reflecting_.push_back(bounds_of(object.shape));
    }
    if (!reflecting_.empty() && lights_.count() > 0) find_lit(estimator);
}

void PossibleLight::find_lit(const estimators::Estimator& estimator) {
    const std::size_t particles = std::clamp<std::size_t>(kMostEstimates / lights_.count(), 1, kParticles);
    for (std::size_t i = 0; i < particles; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const transport::EmittedParticle particle = lights_.sample_emission(stream);
        const auto hit = caster_.closest(particle.origin, particle.direction);
        if (!hit) continue;
        const Material& material = scene_.material(hit->material);
        const double reflectance = reflectance_bound(material).luminance();
        const double lx = sampled_lx(*hit, stream);
        if (!(reflectance > 0 && lx > 0)) continue;
        const double reflected_lm =
            reflectance * particle.flux_lm.luminance() / static_cast<double>(particles);
        lit_.push_back({*hit, reflectance, lx, reflected_lm});
        if (!is_specular(material) && estimator.is_met_by_chance(*hit)) met_by_chance_.push_back(lit_.back());
    }
    std::ranges::stable_sort(met_by_chance_, std::greater{}, &Lit::sample_lx);
}

double PossibleLight::missed(const Measurand& measurand, double largest, std::uint64_t samples) const {
    if (reflecting_.empty() || (largest > 0 && met_by_chance_.empty())) return 0;
    if (const auto* point = std::get_if<MeasuringPoint>(&measurand))
        return missed_lx({point->position, point->normal}, largest, samples);
    if (const auto* body = std::get_if<BodyPoint>(&measurand))
        return missed_lx({body->position, body->axis}, largest, samples) +
               missed_lx({body->position, -body->axis}, largest, samples);
    const auto surface = transport::first_surface(measurand, caster_);
    if (!surface) return 0;
    return missed_lx(*surface, kPi * largest, samples) / kPi;
}

double PossibleLight::missed_lx(SurfacePoint at, double largest_lx, std::uint64_t samples) const {
    const double lift_m = caster_.offset_m(at.position, caster_.lift().largest_size_m());
    const auto is_above = [&](const Bounds& box) { return height_above(at, box) > 2 * lift_m; };
    if (std::ranges::none_of(reflecting_, is_above)) return 0;
    at.lifted = at.position + lift_m * at.normal;
    const double rare = rare_lx(at, largest_lx, samples);
    if (largest_lx > 0) return rare;
    const double sample_lx = std::max(all_lx(at), seen_lx(at));
    return std::max(rare, statistics::rare_light({sample_lx, 0}, samples));
}

double PossibleLight::rare_lx(const SurfacePoint& at, double largest_lx, std::uint64_t samples) const {
    const auto count = static_cast<double>(samples);
    double light_lx = 0, squares = 0, met = 0, brightest_lx = 0;
    for (const Lit& lit : met_by_chance_) {
        if (!(lit.sample_lx() > kBrighter * largest_lx)) break;
        const double of_it_lx = lit.reflected_lm / kPi * seen_per_m2(at, lit);
        met += count * of_it_lx / lit.sample_lx();
        if (met > kMayMiss) break;
        if (of_it_lx > 0) brightest_lx = std::max(brightest_lx, lit.sample_lx());
        light_lx += of_it_lx;
        squares += of_it_lx * of_it_lx;
    }
    return std::min(light_lx + kUnsure * std::sqrt(squares), kMayMiss * brightest_lx / count);
}

double PossibleLight::seen_per_m2(const SurfacePoint& at, const Lit& lit) const {
    const Vec3 offset = lit.point.lifted - at.lifted;
    const double along = -dot(offset, lit.point.normal), above = dot(offset, at.normal);
    if (along <= 0 || above <= 0) return 0;
    if (!(caster_.transmittance({at.lifted, lit.point.lifted}).max() > 0)) return 0;
    const double squared = squared_length(offset);
    return along * above / (squared * squared);
}

double PossibleLight::seen_lx(const SurfacePoint& at) const {
    // Particles carry about equal light, so that each stands for an area of 1 / illuminance.
    double light = 0, area = 0;
    for (const Lit& lit : lit_) {
        const double seen = seen_per_m2(at, lit);
        light += seen * lit.reflectance;
        area += seen / lit.lx;
    }
    return area > 0 ? light / area : 0;
}

double PossibleLight::sampled_lx(const SurfacePoint& at, math::SampleStream& stream) const {
    double sum_lx = 0;
    for (std::size_t light = 0; light < lights_.count(); ++light) {
        const auto sample =
            transport::direct_sample(lights_.sample_incident(light, at, stream.next_two()), at);
        if (sample) sum_lx += sample->illuminance_lx.luminance();
    }
    return sum_lx;
}

double PossibleLight::all_lx(const SurfacePoint& at) const {
    double sum_lx = 0;
    for (std::size_t light = 0; light < lights_.count(); ++light)
        sum_lx += lights_.rough_illuminance_lx(light, at) / lights_.choice_favour(light);
    return sum_lx;
}

}  // namespace stilb::run
