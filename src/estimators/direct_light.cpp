#include "estimators/direct_light.h"

namespace stilb {
namespace {

Spectrum received_lx(const std::optional<IncidentLight>& light, const Vec3& from, const Vec3& normal,
                     const RayCaster& caster) {
    if (!light) return {};
    const double cosine = dot(light->direction, normal);
    if (cosine <= 0 || caster.occluded(from, light->source_point)) return {};
    return cosine * light->normal_illuminance_lx;
}

}  // namespace

Spectrum direct_from_points_lx(const Vec3& from, const Vec3& normal, const RayCaster& caster,
                               const LightSampler& lights) {
    Spectrum sum;
    for (std::size_t light = 0; light < lights.count(); ++light) {
        if (!lights.is_point_like(light)) continue;
        sum += received_lx(lights.sample_incident(light, from, {}), from, normal, caster);
    }
    return sum;
}

Spectrum sample_direct_from_areas_lx(const Vec3& from, const Vec3& normal, const RayCaster& caster,
                                     const LightSampler& lights, SampleStream& stream) {
    Spectrum sum;
    for (std::size_t light = 0; light < lights.count(); ++light) {
        if (lights.is_point_like(light)) continue;
        const auto u = stream.next_two();
        sum += received_lx(lights.sample_incident(light, from, u), from, normal, caster);
    }
    return sum;
}

}  // namespace stilb
