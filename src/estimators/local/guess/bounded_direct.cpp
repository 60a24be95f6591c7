#include "estimators/local/guess/bounded_direct.h"

#include <algorithm>
#include <numbers>

namespace stilb::estimators {
namespace {

/// Light of a point light that sends out equal light everywhere is bounded by so many times the mean
/// illuminance of all surfaces.
constexpr double kMostOfMean = 10;

std::size_t point_count(const Scene& scene) {
    return static_cast<std::size_t>(std::ranges::count_if(
        scene.lights, [](const Light& light) { return location_of(light) == LightLocation::point; }));
}

}  // namespace

BoundedDirect::BoundedDirect(const Scene& scene, const rays::RayCaster& caster,
                             const transport::LightSampler& lights)
    : caster_(caster),
      lights_(lights),
      near_m2_(surface_area_m2(scene) / (4 * std::numbers::pi * kMostOfMean *
                                         static_cast<double>(std::max<std::size_t>(1, point_count(scene))))),
      has_points_(point_count(scene) > 0) {}

auto BoundedDirect::sample_particle(math::SampleStream& stream) const -> std::optional<Particle> {
    const transport::EmittedParticle particle = lights_.sample_emission(stream);
    if (!particle.from_point) return std::nullopt;
    const auto seen = caster_.seen({particle.origin, particle.direction});
    if (!seen.hit) return std::nullopt;
    const double rest = 1 - share(squared_length(seen.hit->position - particle.origin));
    if (stream.next() >= rest) return std::nullopt;
    return Particle{*seen.hit, particle.direction, particle.flux_lm * seen.transmittance, particle.favour,
                    particle.light};
}

}  // namespace stilb::estimators
