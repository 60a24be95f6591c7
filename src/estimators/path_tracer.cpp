#include "estimators/path_tracer.h"

#include <cmath>

#include "estimators/balance.h"
#include "estimators/russian_roulette.h"
#include "estimators/specular_way.h"

namespace stilb {

PathTracer::View PathTracer::look_through(const Hit& hit, const Vec3& direction, int max_reflections,
                                          SampleStream& stream) const {
    View view;
    view.surface = hit;
    view.outgoing = -direction;
    while (is_specular(material(*view.surface))) {
        const auto way =
            choose_specular_way(material(*view.surface), *view.surface, view.outgoing, stream.next());
        const double survival = way ? survival_probability(view.transmission, way->share) : 0;
        if (view.reflections == max_reflections || stream.next() >= survival) {
            view.surface.reset();
            return view;
        }
        ++view.reflections;
        view.transmission *= way->share * (way->luminance_factor / survival);
        view.surface = caster_.closest(way->origin, way->direction);
        if (!view.surface) return view;
        view.outgoing = -way->direction;
        view.emission_cd_m2 += view.transmission * lights_.emitted_luminance(*view.surface);
    }
    return view;
}

std::optional<IncidentLight> PathTracer::sample_light(const Hit& surface, SampleStream& stream) const {
    auto light = lights_.sample_one_light(surface.position, surface.normal, stream);
    if (!light || dot(light->direction, surface.normal) <= 0 ||
        caster_.occluded(surface.lifted, light->source_point)) {
        return std::nullopt;
    }
    return light;
}

std::optional<PathTracer::IncomingBeam> PathTracer::sample_beam(const Hit& surface, const Vec3& outgoing,
                                                                int max_reflections,
                                                                SampleStream& stream) const {
    const Material& material = scene_.material(surface.material);
    const double survival = survival_probability(Spectrum::grey(1), reflectance_bound(material));
    if (stream.next() >= survival) return std::nullopt;
    const Frame frame = Frame::of_surface(surface.normal);
    const auto [u1, u2] = stream.next_two();
    const auto scattered = sample_brdf(material, frame.to_local(outgoing), u1, u2);
    if (!scattered) return std::nullopt;
    const Vec3 direction = frame.to_world(scattered->direction);
    const auto next = caster_.closest(surface.lifted, direction);
    if (!next) return std::nullopt;
    IncomingBeam beam;
    beam.direction = direction;
    beam.luminance_cd_m2 =
        luminance_without_direct(*next, direction, max_reflections, stream) * (1 / survival);
    beam.emission_cd_m2 = lights_.emitted_luminance(*next) * (1 / survival);
    if (beam.emission_cd_m2.max() > 0) {
        beam.light_pdf_per_sr = lights_.pdf_per_sr(*next, surface.position, surface.normal);
    }
    return beam;
}

Spectrum PathTracer::reflected_luminance(const Hit& surface, const Vec3& outgoing, int max_reflections,
                                         SampleStream& stream) const {
    Spectrum luminance;
    Spectrum throughput = Spectrum::grey(1);
    Hit hit = surface;
    Vec3 out = outgoing;
    for (int reflections_left = max_reflections; reflections_left > 0;) {
        const Material& material = scene_.material(hit.material);
        const Frame frame = Frame::of_surface(hit.normal);
        const Vec3 local_out = frame.to_local(out);
        if (const auto light = sample_light(hit, stream)) {
            const Vec3 local_in = frame.to_local(light->direction);
            const double weight = balance(light->pdf_per_sr, pdf_per_sr(material, local_out, local_in));
            luminance += throughput * evaluate_brdf_per_sr(material, local_in, local_out) *
                         (local_in.z * weight) * light->normal_illuminance_lx;
        }
        const double survival = patient_survival_probability(throughput, reflectance_bound(material));
        if (stream.next() >= survival) break;
        const auto [u1, u2] = stream.next_two();
        const auto scattered = sample_brdf(material, local_out, u1, u2);
        if (!scattered) break;
        throughput *= scattered->weight * (1 / survival);
        --reflections_left;
        const Vec3 direction = frame.to_world(scattered->direction);
        const auto next = caster_.closest(hit.lifted, direction);
        if (!next) break;
        const Spectrum emission = lights_.emitted_luminance(*next);
        if (emission.max() > 0) {
            const double light_pdf = lights_.pdf_per_sr(*next, hit.position, hit.normal);
            luminance += throughput * emission * balance(scattered->pdf_per_sr, light_pdf);
        }
        if (!is_specular(this->material(*next))) {
            hit = *next;
            out = -direction;
            continue;
        }
        const View view = look_through(*next, direction, reflections_left, stream);
        luminance += throughput * view.emission_cd_m2;
        if (!view.surface) break;
        throughput *= view.transmission;
        reflections_left -= view.reflections;
        hit = *view.surface;
        out = view.outgoing;
    }
    return luminance;
}

Spectrum PathTracer::luminance_without_direct(const Hit& hit, const Vec3& direction, int max_reflections,
                                              SampleStream& stream) const {
    const View view = look_through(hit, direction, max_reflections, stream);
    if (!view.surface) return view.emission_cd_m2;
    return view.emission_cd_m2 + view.transmission * reflected_luminance(*view.surface, view.outgoing,
                                                                         max_reflections - view.reflections,
                                                                         stream);
}

}  // namespace stilb
