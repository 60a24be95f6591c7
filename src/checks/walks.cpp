#include "checks/walks.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "math/sampling.h"
#include "transport/light_sampler.h"

namespace stilb::checks {

void follow_walk(const Scene& scene, const rays::RayCaster& caster, const Location& start, Vec3 direction,
                 int reflections, math::SampleStream& stream, Trail& trail) {
    Vec3 origin = start.position;
    for (int reflection = 0; reflection <= reflections; ++reflection) {
        const auto hit = caster.closest(origin, direction);
        if (!hit) {
            trail.leaves_scene = true;
            return;
        }
        trail.is_object_met[index_of(hit->object)] = true;
        const auto [u1, u2] = stream.next_two();
        if (transmits(scene.material(hit->material)) && stream.next() < 0.5) {
            origin = hit->lifted_behind();
            continue;
        }
        trail.locations.push_back({hit->lifted, hit->normal});
        origin = hit->lifted;
        direction = Frame::around(hit->normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction);
    }
}

std::vector<Location> lit_places(const Scene& scene, const rays::RayCaster& caster) {
    constexpr std::uint64_t particles = 512;
    constexpr int reflections = 4;
    const transport::LightSampler lights(scene, caster);
    Trail trail(scene);
    for (std::uint64_t i = 0; i < particles; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const transport::EmittedParticle particle = lights.sample_emission(stream);
        const Location start{particle.origin, particle.direction};
        trail.locations.push_back(start);
        follow_walk(scene, caster, start, particle.direction, reflections, stream, trail);
    }
    return std::move(trail.locations);
}

bool sees(const Location& from, const Location& to, const rays::RayCaster& caster) {
    const Vec3 offset = to.position - from.position;
    return dot(offset, from.normal) > 0 && dot(offset, to.normal) < 0 &&
           caster.transmittance({from.position, to.position}).max() > 0;
}

}  // namespace stilb::checks
