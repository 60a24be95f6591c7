#include "estimators/patch_light/particles/illumination_map.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "patches/visibility/item_buffer.h"
#include "transport/russian_roulette.h"

namespace stilb::estimators {

IlluminationMap::IlluminationMap(const PatchTransport& transport)
    : transport_(transport), flux_lm_(2 * transport.patches.count()) {}

void IlluminationMap::add(math::RandomKey key, std::uint64_t first, std::uint64_t count) {
    particles_ += count;
    if (transport_.lights.count() == 0) return;
    std::vector<Particle> together;
    for (std::uint64_t i = first; i < first + count; ++i) {
        together.push_back(leave_light(math::SampleStream(key, i)));
        if (together.size() == kPacketWidth || i + 1 == first + count) walk(together);
    }
}

IlluminationMap::Particle IlluminationMap::leave_light(math::SampleStream stream) const {
    const transport::EmittedParticle emitted = transport_.lights.sample_emission(stream);
    return {stream, emitted.origin, emitted.direction, emitted.flux_lm};
}

/// Particles that share a packet of rays, to the end of the last one.
void IlluminationMap::walk(std::vector<Particle>& particles) {
    while (!particles.empty()) {
        RayPacket packet;
        LaneMask lanes{};
        for (std::size_t lane = 0; lane < particles.size(); ++lane) {
            packet.set(lane, particles[lane].origin - transport_.patches.center, particles[lane].direction,
                       std::numeric_limits<float>::infinity());
            lanes[lane] = -1;
        }
        const patches::PatchHits hits = transport_.patch_caster.closest(packet, lanes);
        rays_ += particles.size();
        std::size_t alive = 0;
        for (std::size_t lane = 0; lane < particles.size(); ++lane) {
            if (hits.sides[lane] == patches::kNoSide ||
                !land(particles[lane], hits.sides[lane], hits.place(lane)))
                continue;
            particles[alive++] = particles[lane];
        }
        particles.erase(particles.begin() + static_cast<std::ptrdiff_t>(alive), particles.end());
    }
}

/// Counts the particle; whether it goes on.
bool IlluminationMap::land(Particle& particle, std::uint32_t side, const math::Barycentric& place) {
    add_to(flux_lm_[side], particle.flux_lm);
    const patches::Patches& patches = transport_.patches;
    const Rgb reflectance = std::numbers::pi * to_rgb(transport_.constant_brdf[patches.patch_of(side)]);
    const double survival = transport::survival_probability(particle.flux_lm, reflectance);
    if (particle.stream.next() >= survival) return false;
    const patches::Viewpoint viewpoint = viewpoint_on(patches, side, place);
    const auto [u1, u2] = particle.stream.next_two();
    particle.origin = viewpoint.position;
    particle.direction = viewpoint.frame.to_world(math::sample_cosine_hemisphere(u1, u2).direction);
    particle.flux_lm *= reflectance * (1 / survival);
    return true;
}

std::vector<FloatRgb> IlluminationMap::reflected_cd_m2() const {
    const patches::Patches& patches = transport_.patches;
    std::vector<FloatRgb> reflected(flux_lm_.size());
    for (std::uint32_t side = 0; side < reflected.size(); ++side) {
        const std::uint32_t patch = patches.patch_of(side);
        const double per_m2 = 1 / (double{patches.areas_m2[patch]} * static_cast<double>(particles_));
        reflected[side] =
            to_float_rgb(to_rgb(transport_.constant_brdf[patch]) * to_rgb(flux_lm_[side]) * per_m2);
    }
    return reflected;
}

}  // namespace stilb::estimators
