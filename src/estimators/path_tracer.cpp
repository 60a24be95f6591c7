#include "estimators/path_tracer.h"

#include <cmath>

#include "estimators/balance.h"
#include "estimators/russian_roulette.h"
#include "estimators/specular_way.h"

namespace stilb {

void PathTracer::trace(std::span<Path> paths, Coherence first) const {
    struct Lit {
        Path* path;
        Spectrum luminance_cd_m2;
    };
    std::vector<Path*> going;
    for (Path& path : paths) going.push_back(&path);
    std::vector<Lit> lit;
    std::vector<Segment> segments;
    std::vector<Ray> rays;
    std::vector<std::uint8_t> blocked(paths.size());
    std::vector<std::optional<Hit>> hits(paths.size());
    for (Coherence coherence = first; !going.empty(); coherence = Coherence::scattered) {
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
        caster_.occluded(segments, coherence, blocked);
        for (std::size_t i = 0; i < lit.size(); ++i) {
            if (blocked[i] == 0) lit[i].path->luminance_cd_m2 += lit[i].luminance_cd_m2;
        }
        caster_.closest(rays, Coherence::scattered, hits);
        count = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (!hits[i]) continue;
            arrive(*going[i], rays[i].direction, *hits[i]);
            going[count++] = going[i];
        }
        going.resize(count);
    }
}

void PathTracer::follow(Path& path) const {
    for (;;) {
        const Step step = take_step(path);
        if (step.connection &&
            !caster_.occluded(step.connection->segment.from, step.connection->segment.to)) {
            path.luminance_cd_m2 += step.connection->luminance_cd_m2;
        }
        if (!step.ray) return;
        const auto next = caster_.closest(step.ray->origin, step.ray->direction);
        if (!next) return;
        arrive(path, step.ray->direction, *next);
    }
}

bool PathTracer::look_through(Path& path) const {
    while (is_specular(material(path.hit))) {
        const Step step = take_step(path);
        if (!step.ray) return false;
        const auto next = caster_.closest(step.ray->origin, step.ray->direction);
        if (!next) return false;
        arrive(path, step.ray->direction, *next);
    }
    return true;
}

PathTracer::Step PathTracer::take_step(Path& path) const {
    if (path.reflections_left == 0) return {};
    --path.reflections_left;
    const Material& material = this->material(path.hit);
    if (is_specular(material)) return {std::nullopt, pass_specular(path, material)};
    return reflect(path, material);
}

std::optional<Ray> PathTracer::pass_specular(Path& path, const Material& material) const {
    const auto way = choose_specular_way(material, path.hit, path.outgoing, path.stream.next());
    const double survival = way ? survival_probability(path.throughput, way->share) : 0;
    if (path.stream.next() >= survival) return std::nullopt;
    path.throughput *= way->share * (way->luminance_factor / survival);
    path.pdf_per_sr = std::numeric_limits<double>::infinity();
    return Ray{way->origin, way->direction};
}

PathTracer::Step PathTracer::reflect(Path& path, const Material& material) const {
    Step step;
    const Hit& hit = path.hit;
    const Frame frame = Frame::of_surface(hit.normal);
    const Vec3 out = frame.to_local(path.outgoing);
    const auto light = lights_.sample_one_light(hit.position, hit.normal, path.stream);
    if (light && dot(light->direction, hit.normal) > 0) {
        const Vec3 in = frame.to_local(light->direction);
        const double weight = balance(light->pdf_per_sr, pdf_per_sr(material, out, in));
        step.connection = {{hit.lifted, light->source_point},
                           path.throughput * evaluate_brdf_per_sr(material, in, out) * (in.z * weight) *
                               light->normal_illuminance_lx};
    }
    const double survival = patient_survival_probability(path.throughput, reflectance_bound(material));
    if (path.stream.next() >= survival) return step;
    const auto [u1, u2] = path.stream.next_two();
    const auto scattered = sample_brdf(material, out, u1, u2);
    if (!scattered) return step;
    path.throughput *= scattered->weight * (1 / survival);
    path.pdf_per_sr = scattered->pdf_per_sr;
    step.ray = {hit.lifted, frame.to_world(scattered->direction)};
    return step;
}

void PathTracer::arrive(Path& path, const Vec3& direction, const Hit& next) const {
    const Spectrum emission = lights_.emitted_luminance(next);
    if (emission.max() > 0) {
        const double light_pdf =
            std::isinf(path.pdf_per_sr) ? 0 : lights_.pdf_per_sr(next, path.hit.position, path.hit.normal);
        path.luminance_cd_m2 += path.throughput * emission * balance(path.pdf_per_sr, light_pdf);
    }
    path.hit = next;
    path.outgoing = -direction;
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

Spectrum PathTracer::luminance_without_direct(const Hit& hit, const Vec3& direction, int max_reflections,
                                              const SampleStream& stream) const {
    Path path{hit, -direction, stream, max_reflections};
    follow(path);
    return path.luminance_cd_m2;
}

}  // namespace stilb
