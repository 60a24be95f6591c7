#include "transport/packet_lights.h"

namespace stilb::transport {

PacketLights::PacketLights(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights)
    : caster_(caster), lights_(lights) {
    if (!lights.leaves_out_lights()) lane_lights_ = LaneLights::of(scene, caster.lift(), lights);
}

math::NumberPacket PacketLights::sample(const rays::SurfacePacket& at, const LaneMask& lanes,
                                        math::StreamPacket& streams, unsigned sobol_dimensions,
                                        LightPacket& light) const {
    if (!lane_lights_) {
        sample_one_by_one(at, lanes, streams, sobol_dimensions, light);
        skip_four(streams);
    }
    const math::NumberPacket numbers = next_four(streams, sobol_dimensions);
    if (lane_lights_) lane_lights_->sample(at, numbers, light);
    return numbers;
}

void PacketLights::sample_one_by_one(const rays::SurfacePacket& at, const LaneMask& lanes,
                                     const math::StreamPacket& streams, unsigned sobol_dimensions,
                                     LightPacket& light) const {
    const Vec3& center = caster_.center();
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        for (RayPacket::Floats& band : light.normal_illuminance_lx) band[i] = 0;
        if (lanes[i] == 0) continue;
        math::SampleStream stream = streams.stream(i, sobol_dimensions);
        const auto incident = lights_.sample_one_light({at.position.at(i) + center, at.normal.at(i)}, stream);
        if (!incident) continue;
        light.source.set(i, incident->source_point - center);
        light.direction.set(i, incident->direction);
        for (std::size_t b = 0; b < kBands; ++b)
            light.normal_illuminance_lx[b][i] = static_cast<float>(incident->normal_illuminance_lx[b]);
        light.inverse_pdf_sr[i] = static_cast<float>(1 / incident->pdf_per_sr);
        light.light[i] = incident->light;
    }
}

double PacketLights::pdf_per_sr(std::size_t light, const rays::Hit& hit, const SurfacePoint& at) const {
    if (!lane_lights_) return lights_.pdf_per_sr(light, hit, at);
    const Vec3& center = caster_.center();
    return double{lane_lights_->pdf_per_sr(light, hit.position - center, at.position - center, at.normal)};
}

}  // namespace stilb::transport
