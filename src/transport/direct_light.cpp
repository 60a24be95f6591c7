#include "transport/direct_light.h"

#include "transport/balance.h"

namespace stilb::transport {
namespace {

/// Without the response. Direction and distance are those of the point itself; only the shadow ray starts
/// lifted.
Rgb illuminance_lx(const IncidentLight& light, const Receiver& receiver, const rays::RayCaster& caster) {
    const double sensitivity = receiver.sensitivity(light.direction);
    if (sensitivity <= 0) return {};
    return sensitivity * light.normal_illuminance_lx *
           caster.transmittance({receiver.lifted(), light.source_point});
}

/// What has no normal receives light from all around.
ReceivingPoint receiving_point(const Receiver& receiver) {
    ReceivingPoint point{receiver.position(), std::nullopt};
    if (squared_length(receiver.normal()) > 0) point.normal = receiver.normal();
    return point;
}

/// The emitters' light along a ray in proportion to the response; beside samples of each light.
Rgb sample_by_response(const Receiver& receiver, const rays::RayCaster& caster, const LightSampler& lights,
                       math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const auto sample = receiver.sample(u1, u2);
    if (!sample) return {};
    const auto seen = caster.seen({receiver.lifted(), sample->direction});
    const Rgb emission = seen.transmittance * (seen.hit ? lights.emitted_luminance(*seen.hit)
                                                        : lights.outside_luminance(sample->direction));
    if (!(emission.max() > 0)) return {};
    const double light_pdf =
        seen.hit ? lights.pdf_of_its_light_per_sr(*seen.hit, receiver.position())
                 : lights.pdf_of_outside_light_per_sr(sample->direction, receiving_point(receiver));
    return sample->weight * emission * balance(sample->pdf_per_sr, light_pdf);
}

}  // namespace

Rgb direct_from_points(const Receiver& receiver, const rays::RayCaster& caster, const LightSampler& lights) {
    Rgb sum;
    for (std::size_t i = 0; i < lights.count(); ++i) {
        if (!lights.is_point(i)) continue;
        if (const auto light = lights.sample_incident(i, receiving_point(receiver), {})) {
            const Rgb received = illuminance_lx(*light, receiver, caster);
            if (received.max() > 0) sum += received * receiver.response(light->direction);
        }
    }
    return sum;
}

Rgb sample_direct_from_areas(const Receiver& receiver, const rays::RayCaster& caster,
                             const LightSampler& lights, math::SampleStream& stream) {
    const bool directional = !receiver.constant_response();
    Rgb sum;
    for (std::size_t i = 0; i < lights.count(); ++i) {
        if (lights.is_point(i)) continue;
        const auto u = stream.next_two();
        const auto light = lights.sample_incident(i, receiving_point(receiver), u);
        if (!light) continue;
        const Rgb received = illuminance_lx(*light, receiver, caster);
        if (!(received.max() > 0)) continue;
        const double weight =
            directional ? balance(light->pdf_per_sr, receiver.pdf_per_sr(light->direction)) : 1;
        sum += received * receiver.response(light->direction) * weight;
    }
    if (directional && lights.has_visible_lights())
        sum += sample_by_response(receiver, caster, lights, stream);
    return sum;
}

}  // namespace stilb::transport
