#include "transport/light_path.h"

#include "materials/shaded_surface.h"
#include "transport/line_of_sight.h"
#include "transport/lobe_choice.h"
#include "transport/weights.h"

namespace stilb::transport {

void trace_light_path(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights,
                      int max_nodes, math::SampleStream stream, std::vector<LightVertex>& nodes) {
    if (lights.count() == 0) return;
    const EmittedParticle particle = lights.sample_emission(stream);
    Vec3 origin = particle.origin;
    Vec3 direction = particle.direction;
    Rgb flux = particle.flux_lm;
    bool only_by_light = false;
    int reflections = 0;
    while (reflections < max_nodes) {
        auto hit = caster.closest(origin, direction);
        if (!hit) return;
        Vec3 from = -direction;
        const auto scattering = choose_lobe(scene.material(hit->material), *hit, from, Carried::flux, stream);
        if (!scattering) return;
        const Material& material = *scattering->material;
        flux *= scattering->weight;
        if (is_specular(material)) {
            const auto branch = choose_specular_ray(material, *hit, from, Carried::flux, stream.next());
            if (branch && !branch->straight) {
                if (reflections == 0) only_by_light = particle.from_point;
                ++reflections;
            }
            const double survival =
                branch ? survival_probability(flux, scattering->lobe ? scattering->sent_on : branch->share)
                       : 0;
            if (stream.next() >= survival) return;
            flux *= branch->share * (1 / survival);
            origin = branch->origin;
            direction = branch->direction;
            continue;
        }
        const double survival = survival_probability(flux, scattering->sent_on);
        if (stream.next() >= survival) return;
        flux *= 1 / survival;
        nodes.push_back({*hit, hit->shading_normal, from, &material, flux, ++reflections, only_by_light,
                         particle.favour, 1, particle.light});
        const materials::ShadedSurface surface(material, hit->normal, hit->shading_normal);
        const auto [u1, u2] = stream.next_two();
        const auto scattered = surface.sample_outgoing(surface.frame().to_local(from), u1, u2);
        if (!scattered) return;
        flux *= scattered->weight;
        direction = surface.frame().to_world(scattered->direction);
        origin = hit->lifted;
    }
}

std::vector<LightVertex> trace_light_paths(const Scene& scene, const rays::RayCaster& caster,
                                           const LightSampler& lights, int max_nodes, math::RandomKey key,
                                           std::uint64_t first, std::uint64_t end) {
    std::vector<LightVertex> nodes;
    for (std::uint64_t path = first; path < end; ++path) {
        trace_light_path(scene, caster, lights, max_nodes, math::SampleStream(key, path), nodes);
    }
    return nodes;
}

}  // namespace stilb::transport
