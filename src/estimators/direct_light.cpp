#include "estimators/direct_light.h"

namespace stilb {
namespace {

/// Direction and distance are those of the point itself; only the shadow ray starts lifted.
Spectrum received_lx(const std::optional<IncidentLight>& light, const PackedPoint& point,
                     const RayCaster& caster) {
    if (!light) return {};
    const double cosine = dot(light->direction, point.normal);
    if (cosine <= 0 || caster.occluded(point.lifted, light->source_point)) return {};
    return cosine * light->normal_illuminance_lx;
}

}  // namespace

std::vector<Spectrum> direct_from_points_lx(std::span<const PackedPoint> points, const RayCaster& caster,
                                            const LightSampler& lights) {
    std::vector<Spectrum> sums(points.size());
    for (const PackedPoint& point : points) {
        for (std::size_t light = 0; light < lights.count(); ++light) {
            if (!lights.is_point_like(light)) continue;
            sums[point.reading] +=
                received_lx(lights.sample_incident(light, point.position, {}), point, caster);
        }
    }
    return sums;
}

Spectrum sample_direct_from_areas_lx(const PackedPoint& point, const RayCaster& caster,
                                     const LightSampler& lights, SampleStream& stream) {
    Spectrum sum;
    for (std::size_t light = 0; light < lights.count(); ++light) {
        if (lights.is_point_like(light)) continue;
        const auto u = stream.next_two();
        sum += received_lx(lights.sample_incident(light, point.position, u), point, caster);
    }
    return sum;
}

}  // namespace stilb
