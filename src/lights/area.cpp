#include "lights/area.h"

#include <numbers>
#include <utility>

#include "math/sampling.h"

namespace stilb::lights {

Rgb AreaLight::flux_lm(const Surroundings& surroundings) const {
    return std::numbers::pi * area_m2(surroundings.shape(object)) * luminance_cd_m2;
}

std::vector<LightDetail> AreaLight::details(const Surroundings& surroundings) const {
    return {{"object", std::string(surroundings.name(object))},
            {"luminance_cd_m2", luminance_cd_m2.luminance()}};
}

AreaEmitter::AreaEmitter(const AreaLight& light, const Surroundings& surroundings, const Lift& lift)
    : luminance_cd_m2_(light.luminance_cd_m2),
      flux_lm_(light.flux_lm(surroundings).luminance()),
      lift_(lift),
      elements_(emitter_elements(surroundings.shape(light.object))) {
    std::vector<double> areas;
    Bounds bounds;
    for (const EmitterElement& element : elements_) {
        areas.push_back(element.area_m2);
        // The points of these four parameters span every kind of element well enough for a rough size.
        for (const auto& u : {std::pair{0.01, 0.01}, {0.99, 0.01}, {0.01, 0.99}, {0.99, 0.99}}) {
            bounds.include(sample_by_area(element, {u.first, u.second}).position);
        }
    }
    by_area_ = math::DiscreteDistribution(areas);
    middle_ = bounds.middle();
    radius_m_ = length(bounds.max - bounds.min) / 2;
}

Emission AreaEmitter::emit(math::SampleStream& stream) const {
    const std::array<double, 2> u = stream.next_two();
    const auto choice = by_area_.choose(u[0]);
    const std::array<double, 2> v = stream.next_two();
    const EmitterElement& element = elements_[choice.index];
    const EmitterPoint point = sample_by_area(element, {choice.remainder, u[1]});
    const Vec3 direction =
        Frame::around(point.normal).to_world(math::sample_cosine_hemisphere(v[0], v[1]).direction);
    return {point.position + lift_.offset_m(point.position, element.size_m) * point.normal, direction,
            Rgb::grey(point.weight)};
}

std::optional<IncidentLight> AreaEmitter::sample_incident(const ReceivingPoint& at,
                                                          const std::array<double, 2>& u) const {
    const auto choice = by_area_.choose(u[0]);
    const EmitterElement& element = elements_[choice.index];
    const auto sample = sample_seen(element, at.position, {choice.remainder, u[1]});
    if (!sample) return std::nullopt;
    const auto& [position, normal, pdf_per_sr] = *sample;
    const Vec3 direction = normalized(position - at.position);
    // Not >=: where `at` is the sampled point itself, there is no direction to compare.
    if (!(dot(normal, direction) < 0)) return std::nullopt;
    return IncidentLight{position + lift_.offset_m(position, element.size_m) * normal, direction,
                         luminance_cd_m2_ * (1 / (pdf_per_sr * choice.probability)),
                         choice.probability * rough_pdf_per_sr(element, position, normal, at.position)};
}

double AreaEmitter::rough_illuminance_lx(const Vec3& from, const Vec3&) const {
    // Never zero: part of the emitter may be above the horizon wherever its middle is.
    const double squared_distance = squared_length(middle_ - from);
    return flux_lm_ / (squared_distance + radius_m_ * radius_m_);
}

double AreaEmitter::pdf_per_sr(std::uint32_t triangle, const Vec3& position, const Vec3& normal,
                               const Vec3& from) const {
    const std::size_t element = elements_.size() == 1 ? 0 : triangle;
    return by_area_.probability(element) * rough_pdf_per_sr(elements_[element], position, normal, from);
}

}  // namespace stilb::lights
