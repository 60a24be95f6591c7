#include "transport/light_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "base/vec.h"
#include "math/sampling.h"
#include "stilb/error.h"
#include "transport/entries.h"
#include "transport/weak_lights.h"

namespace stilb::transport {

LightSampler::LightSampler(const Scene& scene, const rays::RayCaster& caster,
                           std::vector<bool> made_elsewhere)
    : light_of_object_(scene.objects.size(), kNoLight), made_elsewhere_(std::move(made_elsewhere)) {
    std::vector<double> weights;
    double others_lm = 0;
    for (const Light& light : scene.lights) {
        add(light, scene, caster);
        weights.push_back(flux_lm_.back().luminance());
        if (outside_ != weights.size() - 1) others_lm += weights.back();
    }
    if (outside_ != kNoLight && others_lm > 0) weights[outside_] = std::min(weights[outside_], others_lm);
    join_emitters_in_one_place(scene, caster);
    emission_favours_ = emission_favours(weights);
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= emission_favours_[i];
    by_emission_ = math::DiscreteDistribution(weights);
    set_choice_favours(caster);
    const bool chooses_outside = has_light_from_outside() && !is_made_elsewhere(outside_);
    all_ = {leaves(scene, [&](std::uint32_t i) { return !is_made_elsewhere(i); }),
            chooses_outside ? std::optional(outside_) : std::nullopt};
    std::vector<LightTree::Light> extended = leaves(scene, [&](std::uint32_t i) { return !is_point(i); });
    if (extended.size() > LightChoice::kFew) extended_ = {std::move(extended), std::nullopt};
}

void LightSampler::add(const Light& light, const Scene& scene, const rays::RayCaster& caster) {
    const auto number = static_cast<std::uint32_t>(emitters_.size());
    flux_lm_.push_back(scene::flux_lm(scene, light));
    locations_.push_back(location_of(light));
    std::vector<lights::Entry> entries;
    if (locations_[number] == LightLocation::infinity) entries = entries_to(caster);
    emitters_.push_back(lights::make_emitter(light, scene::LightSurroundings(scene, entries), caster.lift()));
    if (const auto object = lights::emitting_object(light)) light_of_object_[index_of(*object)] = number;
    if (locations_[number] == LightLocation::infinity) {
        if (outside_ != kNoLight) {
            throw InputError(
                fmt::format("lights \"{}\" and \"{}\" both surround the scene. Allowed: one environment.",
                            scene.lights[outside_].name, light.name));
        }
        outside_ = number;
    }
    has_visible_lights_ = has_visible_lights_ || !is_point(number);
}

/// Rays cannot tell which of them they meet.
void LightSampler::join_emitters_in_one_place(const Scene& scene, const rays::RayCaster& caster) {
    next_in_place_.resize(count());
    std::map<std::array<long long, 3>, std::vector<std::uint32_t>> by_place;
    for (std::uint32_t light = 0; light < count(); ++light) {
        next_in_place_[light] = light;
        const auto object = lights::emitting_object(scene.lights[light]);
        if (!object) continue;
        constexpr double millimetres = 1e3;
        const Shape& shape = scene.object(*object).shape;
        const Vec3 middle = millimetres * bounds_of(shape).middle();
        std::vector<std::uint32_t>& near =
            by_place[{std::llround(middle.x), std::llround(middle.y), std::llround(middle.z)}];
        const double tolerance_m = caster.offset_m(bounds_of(shape).middle(), 0);
        for (const std::uint32_t other : near) {
            const ObjectId of_other = *lights::emitting_object(scene.lights[other]);
            if (!coincide(shape, scene.object(of_other).shape, tolerance_m)) continue;
            next_in_place_[light] = std::exchange(next_in_place_[other], light);
            break;
        }
        near.push_back(light);
    }
}

void LightSampler::set_choice_favours(const rays::RayCaster& caster) {
    choice_favours_.assign(count(), 1);
    if (count() <= 1) return;
    std::vector<double> flux_lm;
    for (std::size_t i = 0; i < count(); ++i)
        flux_lm.push_back(i == outside_ || is_made_elsewhere(i) ? 0 : flux_lm_[i].luminance());
    choice_favours_ = choice_favours(*this, flux_lm, caster);
}

EmittedParticle LightSampler::sample_emission(math::SampleStream& stream) const {
    const auto choice = by_emission_.choose(stream.next());
    const auto [origin, direction, share, favour] = emit(choice.index, stream);
    return {origin,
            direction,
            share * (flux_lm_[choice.index] * (1 / choice.probability)),
            is_point(choice.index),
            static_cast<std::uint32_t>(choice.index),
            emission_favours_[choice.index] * favour};
}

std::optional<IncidentLight> LightSampler::sample_incident(std::size_t light, const SurfacePoint& at,
                                                           const std::array<double, 2>& u) const {
    std::optional<IncidentLight> incident =
        std::visit([&](const auto& emitter) { return emitter.sample_incident(at, u); }, emitters_[light]);
    if (incident) incident->light = static_cast<std::uint32_t>(light);
    return incident;
}

double LightSampler::rough_illuminance_lx(std::size_t light, const SurfacePoint& at) const {
    if (is_made_elsewhere(light)) return 0;
    return choice_favours_[light] *
           std::visit([&](const auto& emitter) { return emitter.rough_illuminance_lx(at); },
                      emitters_[light]);
}

std::optional<IncidentLight> LightSampler::sample_chosen(std::size_t light, double expected,
                                                         const SurfacePoint& at,
                                                         const std::array<double, 2>& u) const {
    auto incident = sample_incident(light, at, u);
    if (incident) {
        incident->normal_illuminance_lx *= 1 / expected;
        incident->pdf_per_sr *= expected;
    }
    return incident;
}

LightTree::Light LightSampler::leaf(const Scene& scene, std::uint32_t light) const {
    // Between the intensity of a ball and that of a flat surface along its normal.
    const double luminous_lm = choice_favours_[light] * flux_lm_[light].luminance();
    LightTree::Light leaf{light, {}, luminous_lm / (2 * std::numbers::pi), is_point(light)};
    if (const auto origin = lights::point_origin(scene.lights[light])) {
        leaf.bounds.include(origin->position);
        leaf.intensity_cd /= 2;
    }
    if (const auto object = lights::emitting_object(scene.lights[light]))
        leaf.bounds = bounds_of(scene.object(*object).shape);
    return leaf;
}

double LightSampler::extended_pdf_per_sr(std::size_t light, const rays::Hit& hit,
                                         const SurfacePoint& at) const {
    const double pdf_per_sr = pdf_of_its_light_per_sr(light, hit, at);
    if (!(pdf_per_sr > 0) || !chooses_extended(at)) return pdf_per_sr;
    return kExtended * LightChoice::At(extended_, *this, at)
                           .times_probability(pdf_per_sr, static_cast<std::uint32_t>(light));
}

std::optional<IncidentLight> LightSampler::sample_one_light(const SurfacePoint& at,
                                                            math::SampleStream& stream) const {
    if (count() == 1 && !is_made_elsewhere(0)) return sample_incident(0, at, stream.next_two());
    const double u = stream.next();
    const auto point = stream.next_two();
    const LightChoice::At choice_at(all_, *this, at);
    if (choice_at.is_empty()) return std::nullopt;
    const math::DiscreteChoice choice = choice_at.choose(u);
    return sample_chosen(choice.index, choice.probability, at, point);
}

double LightSampler::pdf_of_its_light_per_sr(std::size_t light, const rays::Hit& hit,
                                             const SurfacePoint& at) const {
    return std::visit(
        [&]<typename Emitter>(const Emitter& emitter) -> double {
            if constexpr (lights::SurfaceEmitterKind<Emitter>) {
                return emitter.pdf_per_sr(hit.triangle, hit.position, hit.normal, at.position);
            }
            return 0;
        },
        emitters_[light]);
}

double LightSampler::pdf_per_sr(std::size_t light, const rays::Hit& hit, const SurfacePoint& at) const {
    if (is_made_elsewhere(light)) return std::numeric_limits<double>::infinity();
    return times_choice(pdf_of_its_light_per_sr(light, hit, at), light, at);
}

double LightSampler::times_choice(double pdf_per_sr, std::size_t light, const SurfacePoint& at) const {
    if (count() == 1) return pdf_per_sr;
    return LightChoice::At(all_, *this, at).times_probability(pdf_per_sr, static_cast<std::uint32_t>(light));
}

Rgb LightSampler::outside_luminance(const Vec3& direction) const {
    if (outside_ == kNoLight) return {};
    return std::visit(
        [&]<typename Emitter>(const Emitter& emitter) -> Rgb {
            if constexpr (lights::InfiniteEmitterKind<Emitter>) return emitter.luminance_cd_m2(direction);
            return {};
        },
        emitters_[outside_]);
}

double LightSampler::pdf_of_outside_light_per_sr(const Vec3& direction, const SurfacePoint& at) const {
    if (outside_ == kNoLight) return 0;
    return std::visit(
        [&]<typename Emitter>(const Emitter& emitter) -> double {
            if constexpr (lights::InfiniteEmitterKind<Emitter>) return emitter.pdf_per_sr(direction, at);
            return 0;
        },
        emitters_[outside_]);
}

double LightSampler::outside_pdf_per_sr(const Vec3& direction, const SurfacePoint& at) const {
    if (outside_ == kNoLight) return 0;
    if (is_made_elsewhere(outside_)) return std::numeric_limits<double>::infinity();
    return times_choice(pdf_of_outside_light_per_sr(direction, at), outside_, at);
}

Rgb LightSampler::emitted_luminance(const rays::Hit& hit, const Vec3& leaving, LightParts* parts) const {
    Rgb sum;
    for_each_emission(hit, leaving, [&](std::size_t light, const Rgb& luminance) {
        add_part(luminance, light, 0, sum, parts);
    });
    return sum;
}

Rgb LightSampler::front_luminance(std::size_t light, const Vec3& leaving) const {
    return std::visit(
        [&]<typename Emitter>(const Emitter& emitter) -> Rgb {
            if constexpr (lights::SurfaceEmitterKind<Emitter>) return emitter.luminance_cd_m2(leaving);
            return {};
        },
        emitters_[light]);
}

}  // namespace stilb::transport
