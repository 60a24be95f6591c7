#include "transport/line_of_sight.h"

#include <algorithm>

#include "transport/specular_branch.h"

namespace stilb {
namespace {

/// Share of the luminance below which a way is not followed on.
constexpr double kLeastTransmission = 0.005;
/// Light that is caught in glass could go on for ever.
constexpr int kMostFollowed = 32;

class Looker {
  public:
    Looker(const Scene& scene, const RayCaster& caster, const LightSampler& lights, int max_reflections)
        : scene_(scene), caster_(caster), lights_(lights), max_reflections_(max_reflections) {}

    /// `hit` is seen along `direction`.
    void follow(const Hit& hit, const Vec3& direction, const Spectrum& transmission, int reflections) {
        sight.emission_cd_m2 += transmission * lights_.emitted_luminance(hit);
        const Material& material = scene_.material(hit.material);
        if (!is_specular(material)) {
            sight.sub_points.push_back({hit, -direction, transmission, reflections});
            return;
        }
        for (const SpecularWay& way : specular_ways(material, hit, -direction)) {
            const int met = reflections + (way.straight ? 0 : 1);
            if (met > max_reflections_) continue;
            const Spectrum left = transmission * way.share * way.luminance_factor;
            if (left.max() < kLeastTransmission || met > kMostFollowed) {
                sight.faint.push_back({way.origin, way.direction, left, met});
            } else if (const auto next = caster_.closest(way.origin, way.direction)) {
                follow(*next, way.direction, left, met);
            }
        }
    }

    Sight sight;

  private:
    const Scene& scene_;
    const RayCaster& caster_;
    const LightSampler& lights_;
    int max_reflections_;
};

}  // namespace

std::optional<Hit> first_surface(const Measurand& luminance, const RayCaster& caster) {
    const MeasuringPoint place = place_of(luminance);
    if (std::holds_alternative<LineOfSight>(luminance)) {
        return caster.closest(lifted_position(place, caster), place.normal);
    }
    return surface_at(place, caster);
}

Vec3 looking_direction(const Measurand& luminance) {
    const auto* ray = std::get_if<EmergentRay>(&luminance);
    return ray ? -ray->direction : std::get<LineOfSight>(luminance).direction;
}

Sight look(const Measurand& luminance, const Scene& scene, const RayCaster& caster,
           const LightSampler& lights, int max_reflections) {
    Looker looker(scene, caster, lights, max_reflections);
    if (const auto hit = first_surface(luminance, caster)) {
        looker.follow(*hit, looking_direction(luminance), Spectrum::grey(1), 0);
    }
    std::stable_sort(looker.sight.sub_points.begin(), looker.sight.sub_points.end(),
                     [](const SubPoint& a, const SubPoint& b) {
                         return a.transmission.luminance() > b.transmission.luminance();
                     });
    return std::move(looker.sight);
}

}  // namespace stilb
