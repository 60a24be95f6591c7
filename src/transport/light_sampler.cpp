#include "transport/light_sampler.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/bounds.h"
#include "math/sampling.h"

namespace stilb::lights {
namespace {

/// What leaves a luminaire against `direction`, in the frame of its solid.
Vec3 in_solid(const Luminaire& luminaire, const Vec3& direction) {
    return {-dot(direction, luminaire.c0), -dot(direction, luminaire.c90), -dot(direction, luminaire.nadir)};
}

}  // namespace

LightSampler::LightSampler(const Scene& scene, const rays::RayCaster& caster,
                           std::vector<bool> made_elsewhere)
    : scene_(scene),
      caster_(caster),
      luminance_of_object_(scene.objects.size()),
      light_of_object_(scene.objects.size(), kNoLight),
      made_elsewhere_(std::move(made_elsewhere)) {
    std::vector<double> luminous_flux;
    for (const Light& light : scene.lights) {
        lights_.push_back(&light);
        flux_lm_.push_back(stilb::scene::flux_lm(scene, light));
        luminous_flux.push_back(flux_lm_.back().luminance());
        Emitter emitter;
        if (const auto* area_light = std::get_if<AreaLight>(&light.source)) {
            emitter.elements = lights::emitter_elements(scene.object(area_light->object).shape);
            std::vector<double> areas;
            Bounds bounds;
            for (const lights::EmitterElement& element : emitter.elements) {
                areas.push_back(element.area_m2);
                // The points of these four parameters span every kind of element well enough for a rough
                // size.
                for (const auto& u : {std::pair{0.01, 0.01}, {0.99, 0.01}, {0.01, 0.99}, {0.99, 0.99}}) {
                    bounds.include(lights::sample_by_area(element, {u.first, u.second}).position);
                }
            }
            emitter.by_area = math::DiscreteDistribution(areas);
            emitter.middle = 0.5 * (bounds.min + bounds.max);
            emitter.radius_m = length(bounds.max - bounds.min) / 2;
            luminance_of_object_[index_of(area_light->object)] = area_light->luminance_cd_m2;
            light_of_object_[index_of(area_light->object)] = static_cast<std::uint32_t>(emitters_.size());
            has_area_lights_ = true;
        } else if (const auto* point = std::get_if<PointLight>(&light.source)) {
            emitter.middle = point->position;
        } else {
            const auto& luminaire = std::get<Luminaire>(light.source);
            const double offset = caster.offset_m(luminaire.position, caster.half_extent_m());
            emitter.middle = luminaire.position + offset * luminaire.nadir;
        }
        emitters_.push_back(std::move(emitter));
    }
    by_flux_ = math::DiscreteDistribution(luminous_flux);
}

bool LightSampler::is_point_like(std::size_t light) const { return emitters_[light].elements.empty(); }

EmittedParticle LightSampler::sample_emission(math::SampleStream& stream) const {
    const auto choice = by_flux_.choose(stream.next());
    EmittedParticle particle = emit(choice.index, stream);
    particle.flux_lm *= flux_lm_[choice.index] * (1 / choice.probability);
    particle.from_point = is_point_like(choice.index);
    return particle;
}

EmittedParticle LightSampler::emit(std::size_t light, math::SampleStream& stream) const {
    const std::array<double, 2> u = stream.next_two();
    const Vec3& middle = emitters_[light].middle;
    if (std::holds_alternative<PointLight>(lights_[light]->source)) {
        return {middle, math::sample_sphere(u[0], u[1]).direction, Rgb::grey(1)};
    }
    if (const auto* luminaire = std::get_if<Luminaire>(&lights_[light]->source)) {
        const Vec3 local = scene_.solid(luminaire->solid).sample_direction(u[0], u[1]);
        return {middle,
                normalized(local.x * luminaire->c0 + local.y * luminaire->c90 + local.z * luminaire->nadir),
                Rgb::grey(1)};
    }
    const auto choice = emitters_[light].by_area.choose(u[0]);
    const std::array<double, 2> v = stream.next_two();
    const lights::EmitterElement& element = emitters_[light].elements[choice.index];
    const lights::EmitterPoint point = lights::sample_by_area(element, {choice.remainder, u[1]});
    const Vec3 direction =
        Frame::around(point.normal).to_world(math::sample_cosine_hemisphere(v[0], v[1]).direction);
    return {point.position + caster_.offset_m(point.position, element.size_m) * point.normal, direction,
            Rgb::grey(point.weight)};
}

std::optional<IncidentLight> LightSampler::sample_incident(std::size_t light, const Vec3& from,
                                                           const std::array<double, 2>& u) const {
    const auto from_point = [&](const Vec3& position,
                                const auto& intensity_cd) -> std::optional<IncidentLight> {
        const Vec3 towards = position - from;
        const double squared_distance = squared_length(towards);
        if (squared_distance == 0) return std::nullopt;
        const Vec3 direction = towards / std::sqrt(squared_distance);
        return IncidentLight{emitters_[light].middle, direction,
                             intensity_cd(direction) * (1 / squared_distance),
                             std::numeric_limits<double>::infinity()};
    };
    const auto& source = lights_[light]->source;
    if (const auto* point = std::get_if<PointLight>(&source)) {
        return from_point(point->position, [&](const Vec3&) { return point->intensity_cd; });
    }
    if (const auto* luminaire = std::get_if<Luminaire>(&source)) {
        return from_point(luminaire->position, [&](const Vec3& direction) {
            return scene_.solid(luminaire->solid).intensity_cd(in_solid(*luminaire, direction)) *
                   luminaire->factor;
        });
    }
    return sample_area_light(light, from, u);
}

std::optional<IncidentLight> LightSampler::sample_area_light(std::size_t light, const Vec3& from,
                                                             const std::array<double, 2>& u) const {
    const auto choice = emitters_[light].by_area.choose(u[0]);
    const lights::EmitterElement& element = emitters_[light].elements[choice.index];
    const auto sample = lights::sample_seen(element, from, {choice.remainder, u[1]});
    if (!sample) return std::nullopt;
    const auto& [position, normal, pdf_per_sr] = *sample;
    const Vec3 direction = normalized(position - from);
    // Not >=: where `from` is the sampled point itself, there is no direction to compare.
    if (!(dot(normal, direction) < 0)) return std::nullopt;
    const Rgb& luminance = std::get<AreaLight>(lights_[light]->source).luminance_cd_m2;
    return IncidentLight{position + caster_.offset_m(position, element.size_m) * normal, direction,
                         luminance * (1 / (pdf_per_sr * choice.probability)),
                         choice.probability * lights::rough_pdf_per_sr(element, position, normal, from)};
}

double LightSampler::rough_illuminance(std::size_t light, const Vec3& from, const Vec3& normal) const {
    if (is_made_elsewhere(light)) return 0;
    const auto from_point = [&](const Vec3& position, const auto& intensity_cd) {
        const Vec3 towards = position - from;
        const double squared_distance = squared_length(towards);
        const double height = dot(towards, normal);
        if (!(height > 0)) return 0.0;
        const double distance = std::sqrt(squared_distance);
        return intensity_cd(towards / distance) * height / (squared_distance * distance);
    };
    const auto& source = lights_[light]->source;
    if (const auto* point = std::get_if<PointLight>(&source)) {
        return from_point(point->position, [&](const Vec3&) { return point->intensity_cd.luminance(); });
    }
    if (const auto* luminaire = std::get_if<Luminaire>(&source)) {
        return from_point(luminaire->position, [&](const Vec3& direction) {
            const double bound_cd =
                scene_.solid(luminaire->solid).intensity_bound_cd(in_solid(*luminaire, direction));
            return bound_cd * luminaire->factor.luminance();
        });
    }
    // Never zero: part of the emitter may be above the horizon wherever its middle is.
    const Emitter& emitter = emitters_[light];
    const double squared_distance = squared_length(emitter.middle - from);
    return flux_lm_[light].luminance() / (squared_distance + emitter.radius_m * emitter.radius_m);
}

std::optional<IncidentLight> LightSampler::sample_one_light(const Vec3& from, const Vec3& normal,
                                                            math::SampleStream& stream) const {
    if (count() == 1 && !is_made_elsewhere(0)) return sample_incident(0, from, stream.next_two());
    const double u = stream.next();
    const auto point = stream.next_two();
    std::vector<double> weights(count());
    double total = 0;
    for (std::size_t light = 0; light < count(); ++light) {
        total += weights[light] = rough_illuminance(light, from, normal);
    }
    if (!(total > 0)) return std::nullopt;
    const auto choice = math::DiscreteDistribution(weights).choose(u);
    auto incident = sample_incident(choice.index, from, point);
    if (incident) {
        incident->normal_illuminance_lx *= 1 / choice.probability;
        incident->pdf_per_sr *= choice.probability;
    }
    return incident;
}

double LightSampler::pdf_of_its_light_per_sr(const rays::Hit& hit, const Vec3& from) const {
    const std::uint32_t light = light_of_object_[index_of(hit.object)];
    if (light == kNoLight) return 0;
    const Emitter& emitter = emitters_[light];
    const std::size_t element = emitter.elements.size() == 1 ? 0 : hit.triangle;
    return emitter.by_area.probability(element) *
           lights::rough_pdf_per_sr(emitter.elements[element], hit.position, hit.normal, from);
}

double LightSampler::pdf_per_sr(const rays::Hit& hit, const Vec3& from, const Vec3& normal) const {
    const std::uint32_t light = light_of_object_[index_of(hit.object)];
    if (light == kNoLight) return 0;
    if (is_made_elsewhere(light)) return std::numeric_limits<double>::infinity();
    const double pdf = pdf_of_its_light_per_sr(hit, from);
    if (count() == 1) return pdf;
    double total = 0;
    for (std::size_t i = 0; i < count(); ++i) total += rough_illuminance(i, from, normal);
    return total > 0 ? pdf * rough_illuminance(light, from, normal) / total : 0;
}

Rgb LightSampler::emitted_luminance(const rays::Hit& hit) const {
    return hit.on_front ? luminance_of_object_[index_of(hit.object)] : Rgb{};
}

}  // namespace stilb::lights
