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

std::vector<Spectrum> direct_from_points_lx(std::span<const PackedPoint> points, const RayCaster& caster,
                                            const LightSampler& lights) {
    std::vector<Spectrum> sums(points.size());
    for (const auto& [position, normal, reading] : points) {
        for (std::size_t light = 0; light < lights.count(); ++light) {
            if (!lights.is_point_like(light)) continue;
            sums[reading] +=
                received_lx(lights.sample_incident(light, position, {}), position, normal, caster);
        }
    }
    return sums;
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
