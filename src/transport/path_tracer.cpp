#include "transport/path_tracer.h"

#include <cmath>

#include "materials/shaded_surface.h"
#include "transport/line_of_sight.h"
#include "transport/weights.h"

namespace stilb::transport {

void PathTracer::trace(std::span<Path> paths, rays::Coherence first) const {
    struct Lit {
        Path* path;
        Rgb luminance_cd_m2;
    };
    std::vector<Path*> going;
    for (Path& path : paths) going.push_back(&path);
    std::vector<Lit> lit;
    std::vector<rays::Segment> segments;
    std::vector<rays::Ray> rays;
    std::vector<Rgb> transmittances(paths.size());
    std::vector<std::optional<rays::Hit>> hits(paths.size());
    for (rays::Coherence coherence = first; !going.empty(); coherence = rays::Coherence::scattered) {
        if (stored_) add_stored_reflection(going, coherence);
        lit.clear(), segments.clear(), rays.clear();
        std::size_t count = 0;
        for (Path* path : going) {
            const Step step = take_step(*path);
            if (step.connection) {
                segments.push_back(step.connection->segment);
                lit.push_back({path, step.connection->luminance_cd_m2});
            }
            if (step.ray) {
                rays.push_back(*step.ray);
                going[count++] = path;
            }
        }
        caster_.transmittances(segments, coherence, transmittances);
        for (std::size_t i = 0; i < lit.size(); ++i) {
            lit[i].path->luminance_cd_m2 += lit[i].luminance_cd_m2 * transmittances[i];
        }
        caster_.closest(rays, rays::Coherence::scattered, hits);
        count = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (!hits[i]) {
                leave(*going[i], rays[i].direction);
                continue;
            }
            arrive(*going[i], rays[i].direction, *hits[i]);
            going[count++] = going[i];
        }
        going.resize(count);
    }
}

void PathTracer::follow(Path& path) const {
    Path* const self = &path;
    for (;;) {
        if (stored_) add_stored_reflection({&self, 1}, rays::Coherence::scattered);
        const Step step = take_step(path);
        if (step.connection) {
            path.luminance_cd_m2 +=
                step.connection->luminance_cd_m2 * caster_.transmittance(step.connection->segment);
        }
        if (!step.ray) return;
        const auto next = caster_.closest(step.ray->origin, step.ray->direction);
        if (!next) return leave(path, step.ray->direction);
        arrive(path, step.ray->direction, *next);
    }
}

bool PathTracer::follow_to_scattering(Path& path) const {
    while (is_specular(material(path.hit))) {
        const Step step = take_step(path);
        if (!step.ray) return false;
        const auto next = caster_.closest(step.ray->origin, step.ray->direction);
        if (!next) {
            leave(path, step.ray->direction);
            return false;
        }
        arrive(path, step.ray->direction, *next);
    }
    return true;
}

PathTracer::Step PathTracer::take_step(Path& path) const {
    const Material& material = this->material(path.hit);
    if (is_specular(material)) return {std::nullopt, pass_specular(path, material)};
    if (path.reflections_left == 0) return {};
    --path.reflections_left;
    return reflect(path, material);
}

void PathTracer::add_stored_reflection(std::span<Path* const> paths, rays::Coherence coherence) const {
    std::vector<Path*> reflecting;
    for (Path* path : paths) {
        if (path->reflections_left > 0 && !is_specular(material(path->hit))) reflecting.push_back(path);
    }
    stored_->add_to(reflecting, coherence);
}

std::optional<rays::Ray> PathTracer::pass_specular(Path& path, const Material& material) const {
    const auto branch =
        choose_specular_ray(material, path.hit, path.outgoing, Carried::luminance, path.stream.next());
    const double survival = branch ? survival_probability(path.throughput, branch->share) : 0;
    if (path.stream.next() >= survival) return std::nullopt;
    path.throughput *= branch->share * (branch->luminance_factor / survival);
    if (!branch->straight) {
        if (path.reflections_left == 0) return std::nullopt;
        --path.reflections_left;
        path.previous_vertex = {};
    }
    return rays::Ray{branch->origin, branch->direction};
}

PathTracer::Step PathTracer::reflect(Path& path, const Material& material) const {
    Step step;
    const rays::Hit& hit = path.hit;
    const materials::ShadedSurface surface(material, hit.normal, hit.shading_normal);
    const Frame& frame = surface.frame();
    const Vec3 out = frame.to_local(path.outgoing);
    const auto light = lights_.sample_one_light(hit.position, hit.normal, path.stream);
    if (light && dot(light->direction, hit.normal) > 0) {
        const Vec3 in = frame.to_local(light->direction);
        const auto [brdf_per_sr, pdf_per_sr] = surface.evaluate(in, out);
        const double weight = balance(light->pdf_per_sr, pdf_per_sr);
        step.connection = {{hit.lifted, light->source_point},
                           path.throughput * brdf_per_sr * (in.z * weight) * light->normal_illuminance_lx};
    }
    const double survival = patient_survival_probability(path.throughput, reflectance_bound(material));
    if (path.stream.next() >= survival) return step;
    const auto [u1, u2] = path.stream.next_two();
    const auto scattered = surface.sample_incoming(out, u1, u2);
    if (!scattered) return step;
    path.throughput *= scattered->weight * (1 / survival);
    path.previous_vertex = {scattered->pdf_per_sr, hit.position, hit.normal};
    step.ray = {hit.lifted, frame.to_world(scattered->direction)};
    return step;
}

double PathTracer::share_of(const PreviousVertex& previous_vertex, const rays::Hit& emitter) const {
    if (previous_vertex.pdf_per_sr == 0 || std::isinf(previous_vertex.pdf_per_sr))
        return previous_vertex.pdf_per_sr == 0 ? 0 : 1;
    return balance(previous_vertex.pdf_per_sr,
                   lights_.pdf_per_sr(emitter, previous_vertex.position, previous_vertex.normal));
}

double PathTracer::share_of_outside(const PreviousVertex& previous_vertex, const Vec3& direction) const {
    if (previous_vertex.pdf_per_sr == 0 || std::isinf(previous_vertex.pdf_per_sr))
        return previous_vertex.pdf_per_sr == 0 ? 0 : 1;
    return balance(previous_vertex.pdf_per_sr,
                   lights_.outside_pdf_per_sr(direction, previous_vertex.position, previous_vertex.normal));
}

void PathTracer::leave(Path& path, const Vec3& direction) const {
    const Rgb luminance = lights_.outside_luminance(direction);
    if (luminance.max() > 0)
        path.luminance_cd_m2 +=
            path.throughput * luminance * share_of_outside(path.previous_vertex, direction);
}

void PathTracer::arrive(Path& path, const Vec3& direction, const rays::Hit& next) const {
    const Rgb emission = lights_.emitted_luminance(next);
    if (emission.max() > 0)
        path.luminance_cd_m2 += path.throughput * emission * share_of(path.previous_vertex, next);
    path.hit = next;
    path.outgoing = -direction;
}

std::optional<IncidentLight> PathTracer::sample_light(const rays::Hit& surface,
                                                      math::SampleStream& stream) const {
    auto light = lights_.sample_one_light(surface.position, surface.normal, stream);
    if (!light || dot(light->direction, surface.normal) <= 0) return std::nullopt;
    light->normal_illuminance_lx *= caster_.transmittance({surface.lifted, light->source_point});
    if (!(light->normal_illuminance_lx.max() > 0)) return std::nullopt;
    return light;
}

Rgb PathTracer::luminance_behind(const rays::Hit& hit, const Vec3& direction,
                                 const PreviousVertex& previous_vertex, int max_reflections,
                                 const math::SampleStream& stream) const {
    Path path{hit, -direction, stream, max_reflections};
    path.previous_vertex = previous_vertex;
    follow(path);
    return path.luminance_cd_m2;
}

Rgb PathTracer::incoming_luminance(const rays::Ray& ray, const PreviousVertex& previous_vertex,
                                   int max_reflections, const math::SampleStream& stream) const {
    const auto hit = caster_.closest(ray.origin, ray.direction);
    if (!hit) {
        const Rgb outside = lights_.outside_luminance(ray.direction);
        return outside.max() > 0 ? outside * share_of_outside(previous_vertex, ray.direction) : Rgb{};
    }
    Rgb luminance = luminance_behind(*hit, ray.direction, previous_vertex, max_reflections, stream);
    const Rgb emission = lights_.emitted_luminance(*hit);
    if (emission.max() > 0) luminance += emission * share_of(previous_vertex, *hit);
    return luminance;
}

}  // namespace stilb::transport
