#include "transport/direct/one_receiver.h"

#include "transport/weights.h"

namespace stilb::transport {

namespace {

/// A light's sample, with the receiver's sensitivity and shadows, without its response. Direction and
/// distance are those of the point itself; only the shadow ray starts lifted.
Rgb received_lx(const IncidentLight& light, const Receiver& receiver, const rays::RayCaster& caster) {
    const double sensitivity = receiver.sensitivity(light.direction);
    if (sensitivity <= 0) return {};
    return sensitivity * light.normal_illuminance_lx *
           caster.transmittance({receiver.lifted(), light.source_point});
}

/// The emitters' light along a ray in proportion to the response; combined with samples of each light.
Rgb sample_by_response(const Receiver& receiver, const rays::RayCaster& caster, const LightSampler& lights,
                       math::SampleStream& stream, LightParts* parts) {
    const auto [u1, u2] = stream.next_two();
    const auto sample = receiver.sample(u1, u2);
    if (!sample) return {};
    const auto seen = caster.seen({receiver.lifted(), sample->direction});
    const SurfacePoint& at = receiver.point();
    Rgb sum;
    const auto add = [&](const Rgb& emission, double light_pdf, std::size_t light) {
        add_part(sample->weight * (seen.transmittance * emission) * balance(sample->pdf_per_sr, light_pdf),
                 light, 0, sum, parts);
    };
    if (seen.hit) {
        lights.for_each_emission(*seen.hit, -sample->direction, [&](std::size_t light, const Rgb& emission) {
            add(emission, lights.extended_pdf_per_sr(light, *seen.hit, at), light);
        });
    } else if (const Rgb emission = lights.outside_luminance(sample->direction); emission.max() > 0) {
        add(emission, lights.pdf_of_outside_light_per_sr(sample->direction, at), lights.light_from_outside());
    }
    return sum;
}

}  // namespace

Rgb direct_from_points(const Receiver& receiver, const rays::RayCaster& caster, const LightSampler& lights,
                       LightParts* parts) {
    Rgb sum;
    for (std::size_t i = 0; i < lights.count(); ++i) {
        if (!lights.is_point(i)) continue;
        if (const auto light = lights.sample_incident(i, receiver.point(), {})) {
            const Rgb received = received_lx(*light, receiver, caster);
            if (received.max() > 0)
                add_part(received * receiver.response(light->direction).value, i, 0, sum, parts);
        }
    }
    return sum;
}

Rgb sample_direct_from_areas(const Receiver& receiver, const rays::RayCaster& caster,
                             const LightSampler& lights, math::SampleStream& stream, LightParts* parts) {
    const bool directional = !receiver.constant_response();
    Rgb sum;
    lights.sample_extended(receiver.point(), stream, [&](const IncidentLight& light) {
        const Rgb received = received_lx(light, receiver, caster);
        if (!(received.max() > 0)) return;
        const double weight =
            directional ? balance(light.pdf_per_sr, receiver.pdf_per_sr(light.direction)) : 1;
        add_part(received * receiver.response(light.direction).value * weight, light.light, 0, sum, parts);
    });
    if (directional && lights.has_visible_lights())
        sum += sample_by_response(receiver, caster, lights, stream, parts);
    return sum;
}

}  // namespace stilb::transport
