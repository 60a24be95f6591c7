#include "transport/path_tracer.h"

#include <cmath>

#include "materials/diffuse.h"
#include "materials/shaded_surface.h"
#include "transport/line_of_sight.h"
#include "transport/path_wave.h"
#include "transport/weights.h"

namespace stilb::transport {
PathTracer::PathTracer(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights,
                       const StoredReflection* stored)
    : scene_(scene),
      caster_(caster),
      lights_(lights),
      stored_(stored),
      plain_materials_(scene.materials.size()),
      may_emit_(scene.objects.size()),
      packet_lights_(scene, caster, lights) {
    for (const Light& light : scene.lights) {
        if (const auto surface = lights::emitting_object(light)) may_emit_[index_of(*surface)] = true;
    }
    if (stored_) return;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const auto* diffuse = scene.materials[i].material.get_if<Diffuse>();
        if (diffuse == nullptr) continue;
        plain_materials_[i].is_plain = true;
        for (std::size_t b = 0; b < kBands; ++b)
            plain_materials_[i].reflectance[b] = static_cast<float>(diffuse->reflectance[b]);
    }
}

namespace {

/// `sent_on`: the share of the light that the surface sends on.
double survival_probability(const Path& path, const Rgb& sent_on, const LobeChoice& lobe) {
    return patient_survival_probability(path.throughput * (1 / lobe.weight), sent_on);
}

}  // namespace

void PathTracer::trace(std::span<Path> paths, rays::Coherence first) const {
    if (paths.empty()) return;
    std::vector<Rgb> luminances_cd_m2(paths.size());
    PathWave wave(*this, paths[0].stream.sobol_dimensions(), luminances_cd_m2);
    wave.trace_from_hits(paths, first);
    for (std::size_t i = 0; i < paths.size(); ++i) paths[i].luminance_cd_m2 += luminances_cd_m2[i];
}

void PathTracer::trace(std::span<PathPacket> packets, std::span<const LaneMask> lanes,
                       unsigned sobol_dimensions, rays::Coherence first,
                       std::span<Rgb> luminances_cd_m2) const {
    PathWave(*this, sobol_dimensions, luminances_cd_m2).trace_from_rays(packets, lanes, first);
}

void PathTracer::follow(Path& path) const {
    for (;;) {
        add_stored_reflection({&path, 1}, rays::Coherence::scattered);
        const Step step = take_step(path);
        if (step.connection) {
            path.add(step.connection->luminance_cd_m2 * caster_.transmittance(step.connection->segment),
                     step.connection->light);
        }
        if (!step.ray) return;
        const auto next = caster_.closest(step.ray->origin, step.ray->direction);
        if (!next) return leave(path, step.ray->direction);
        arrive(path, step.ray->direction, *next);
    }
}

std::optional<LobeChoice> PathTracer::follow_to_scattering(Path& path) const {
    for (;;) {
        const auto scattering = choose_lobe(path);
        if (!scattering || !is_specular(*scattering->material)) return scattering;
        if (!pass(path, *scattering)) return std::nullopt;
    }
}

bool PathTracer::pass(Path& path, const LobeChoice& specular) const {
    const auto ray = pass_specular(path, specular);
    if (!ray) return false;
    const auto next = caster_.closest(ray->origin, ray->direction);
    if (next) {
        arrive(path, ray->direction, *next);
    } else {
        leave(path, ray->direction);
    }
    return next.has_value();
}

std::optional<LobeChoice> PathTracer::choose_lobe(Path& path) const {
    const auto scattering =
        transport::choose_lobe(material(path.hit), path.hit, path.outgoing, Carried::luminance, path.stream);
    if (scattering) path.throughput *= scattering->weight;
    return scattering;
}

PathTracer::Step PathTracer::take_step(Path& path) const {
    const auto scattering = choose_lobe(path);
    if (!scattering) return {};
    if (is_specular(*scattering->material)) return {std::nullopt, pass_specular(path, *scattering)};
    if (path.reflections_left == 0) return {};
    --path.reflections_left, ++path.reflections;
    return reflect(path, *scattering);
}

void PathTracer::add_stored_reflection(std::span<Path> paths, rays::Coherence coherence) const {
    if (!stored_) return;
    std::vector<Path*> reflecting;
    for (Path& path : paths) {
        if (path.reflections_left > 0 && !is_specular(material(path.hit))) reflecting.push_back(&path);
    }
    stored_->add_to(reflecting, coherence);
}

std::optional<rays::Ray> PathTracer::pass_specular(Path& path, const LobeChoice& specular) const {
    const auto branch = choose_specular_ray(*specular.material, path.hit, path.outgoing, Carried::luminance,
                                            path.stream.next());
    const double survival =
        branch ? survival_probability(path, specular.lobe ? specular.sent_on : branch->share, specular) : 0;
    if (path.stream.next() >= survival) return std::nullopt;
    path.throughput *= branch->share * (branch->luminance_factor / survival);
    if (!branch->straight) {
        if (path.reflections_left == 0) return std::nullopt;
        --path.reflections_left, ++path.reflections;
        path.previous_vertex = {};
    }
    return rays::Ray{branch->origin, branch->direction};
}

PathTracer::Step PathTracer::reflect(Path& path, const LobeChoice& scattering) const {
    Step step;
    const rays::Hit& hit = path.hit;
    const materials::ShadedSurface surface(*scattering.material, hit.normal, hit.shading_normal);
    const Frame& frame = surface.frame();
    const Vec3 out = frame.to_local(path.outgoing);
    const auto light = lights_.sample_one_light(hit, path.stream);
    if (light && dot(light->direction, hit.normal) > 0) {
        const Vec3 in = frame.to_local(light->direction);
        const auto [brdf_per_sr, pdf_per_sr] = surface.evaluate(in, out);
        const double weight = balance(light->pdf_per_sr, pdf_per_sr);
        step.connection = {{hit.lifted, light->source_point},
                           path.throughput * brdf_per_sr * (in.z * weight) * light->normal_illuminance_lx,
                           light->light};
    }
    const double survival = survival_probability(path, scattering.sent_on, scattering);
    if (path.stream.next() >= survival) return step;
    const auto [u1, u2] = path.stream.next_two();
    const auto scattered = surface.sample_incoming(out, u1, u2);
    if (!scattered) return step;
    path.throughput *= scattered->weight * (1 / survival);
    path.previous_vertex = {scattered->pdf_per_sr, hit};
    step.ray = {hit.lifted, frame.to_world(scattered->direction)};
    return step;
}

double PathTracer::pdf_per_sr(const PreviousVertex& previous_vertex, std::size_t light,
                              const rays::Hit& emitter) const {
    const SurfacePoint& from = previous_vertex.point;
    return previous_vertex.in_packet ? packet_lights_.pdf_per_sr(light, emitter, from)
                                     : lights_.pdf_per_sr(light, emitter, from);
}

void PathTracer::leave(Path& path, const Vec3& direction) const {
    visit_outside_light_towards(
        path.previous_vertex, direction,
        [&](const Rgb& luminance, std::size_t light) { path.add(path.throughput * luminance, light); });
}

void PathTracer::arrive(Path& path, const Vec3& direction, const rays::Hit& next) const {
    for_each_emission_towards(
        path.previous_vertex, next, -direction,
        [&](const Rgb& luminance, std::size_t light) { path.add(path.throughput * luminance, light); });
    path.hit = next;
    path.outgoing = -direction;
}

std::optional<IncidentLight> PathTracer::sample_light(const rays::Hit& surface,
                                                      math::SampleStream& stream) const {
    auto light = lights_.sample_one_light(surface, stream);
    if (!light || dot(light->direction, surface.normal) <= 0) return std::nullopt;
    light->normal_illuminance_lx *= caster_.transmittance({surface.lifted, light->source_point});
    if (!(light->normal_illuminance_lx.max() > 0)) return std::nullopt;
    return light;
}

Rgb PathTracer::luminance_behind(const rays::Hit& hit, const Vec3& direction,
                                 const PreviousVertex& previous_vertex, int max_reflections,
                                 math::SampleStream& stream, LightParts* parts) const {
    Path path{hit, -direction, stream, max_reflections};
    path.previous_vertex = previous_vertex;
    path.parts = parts;
    follow(path);
    stream = path.stream;
    return path.luminance_cd_m2;
}

Rgb PathTracer::incoming_luminance(const rays::Ray& ray, const PreviousVertex& previous_vertex,
                                   int max_reflections, math::SampleStream& stream, LightParts* parts) const {
    Rgb sum;
    const auto add = [&](const Rgb& luminance, std::size_t light) {
        add_part(luminance, light, 0, sum, parts);
    };
    const auto hit = caster_.closest(ray.origin, ray.direction);
    if (!hit) {
        visit_outside_light_towards(previous_vertex, ray.direction, add);
        return sum;
    }
    for_each_emission_towards(previous_vertex, *hit, -ray.direction, add);
    return sum + luminance_behind(*hit, ray.direction, previous_vertex, max_reflections, stream, parts);
}

}  // namespace stilb::transport
