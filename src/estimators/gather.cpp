#include "estimators/gather.h"

#include <numbers>

#include "base/sampling.h"

namespace stilb {

Spectrum sample_gathered_lx(const MeasuringPoint& point, double k_per_m2, int max_reflections,
                            const RayCaster& caster, const PathTracer& tracer, SampleStream& stream) {
    constexpr double pi = std::numbers::pi;
    const auto [u1, u2] = stream.next_two();
    const double survival_number = stream.next();
    const Vec3 local = sample_cosine_hemisphere(u1, u2).direction;
    const Vec3 direction = Frame::around(point.normal).to_world(local);
    const auto hit = caster.closest(lifted_position(point, caster), direction);
    if (!hit) return {};
    const PathTracer::View view = tracer.look_through_mirrors(*hit, direction, max_reflections, stream);
    Spectrum luminance = view.emission_cd_m2;
    if (view.surface) {
        double remaining = 1;  // 1 - w
        if (view.reflections == 0) {
            const double g = local.z * -dot(hit->normal, direction) / (hit->distance_m * hit->distance_m);
            remaining = g / (k_per_m2 + g);
        }
        // Russian roulette with 1 - w itself: what survives has weight 1.
        if (survival_number < remaining) {
            luminance +=
                view.transmission * tracer.reflected_luminance(*view.surface, view.outgoing,
                                                               max_reflections - view.reflections, stream);
        }
    }
    return pi * luminance;
}

}  // namespace stilb
