#include "checks/walks.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "math/sampling.h"
#include "transport/light_sampler.h"

namespace stilb::checks {

void follow_walk(const Scene& scene, const rays::RayCaster& caster, rays::Ray ray, int reflections,
                 math::SampleStream& stream, Trail& trail) {
    for (int reflection = 0; reflection <= reflections; ++reflection) {
        const auto hit = caster.closest(ray.origin, ray.direction);
        if (!hit) {
            trail.leaves_scene = true;
            return;
        }
        trail.is_object_met[index_of(hit->object)] = true;
        const auto [u1, u2] = stream.next_two();
        if (transmits(scene.material(hit->material)) && stream.next() < 0.5) {
            ray.origin = hit->lifted_behind();
            continue;
        }
        trail.points.push_back(*hit);
        ray = {hit->lifted,
               Frame::around(hit->normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction)};
    }
}

std::vector<SurfacePoint> lit_places(const Scene& scene, const rays::RayCaster& caster) {
    constexpr std::uint64_t particles = 512;
    constexpr int reflections = 4;
    const transport::LightSampler lights(scene, caster);
    Trail trail(scene);
    for (std::uint64_t i = 0; i < particles; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const transport::EmittedParticle particle = lights.sample_emission(stream);
        trail.points.push_back({particle.origin, particle.direction});
        follow_walk(scene, caster, {particle.origin, particle.direction}, reflections, stream, trail);
    }
    return std::move(trail.points);
}

bool sees(const SurfacePoint& from, const SurfacePoint& to, const rays::RayCaster& caster) {
    const Vec3 offset = to.lifted - from.lifted;
    return dot(offset, from.normal) > 0 && dot(offset, to.normal) < 0 &&
           caster.transmittance({from.lifted, to.lifted}).max() > 0;
}

}  // namespace stilb::checks
