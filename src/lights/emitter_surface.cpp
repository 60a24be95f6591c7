#include "lights/emitter_surface.h"

#include <algorithm>
#include <utility>

namespace stilb::lights {
namespace {

/// The area of an element that a receiver may see; 0 where its front faces away.
double facing_area_m2(const EmitterElement& element, const Vec3& from) {
    if (!element.normal) return element.area_m2;
    return dot(from - element.middle, *element.normal) > 0 ? element.area_m2 : 0;
}

double projected_area_m2(const EmitterElement& element, const Vec3& leaving) {
    if (!element.normal) return element.area_m2;
    return element.area_m2 * std::max(dot(*element.normal, leaving), 0.0);
}

/// Points of a sphere by the area that a direction sees: uniform on its disk.
EmitterPoint sample_disk_of(const Sphere& sphere, const Vec3& leaving, const std::array<double, 2>& u) {
    const math::DiskPoint p = math::sample_unit_disk(u[0], u[1]);
    const double height = std::sqrt(std::max(0.0, 1 - p.x * p.x - p.y * p.y));
    const Vec3 normal = Frame::around(leaving).to_world({p.x, p.y, height});
    return {{sphere.center + sphere.radius * normal, normal}};
}

}  // namespace

EmitterSurface::EmitterSurface(const Shape& shape, const Lift& lift)
    : lift_(lift), elements_(emitter_elements(shape)) {
    std::vector<double> areas;
    Bounds bounds;
    for (const EmitterElement& element : elements_) {
        areas.push_back(element.area_m2);
        // The points of these four parameters span every kind of element well enough for a rough size.
        for (const auto& u : {std::pair{0.01, 0.01}, {0.99, 0.01}, {0.01, 0.99}, {0.99, 0.99}})
            bounds.include(lights::sample_by_area(element, {u.first, u.second}).position);
    }
    by_area_ = math::DiscreteDistribution(areas);
    middle_ = bounds.middle();
    radius_m_ = length(bounds.max - bounds.min) / 2;
}

double EmitterSurface::projected_area_m2(const Vec3& leaving) const {
    double sum = 0;
    for (const EmitterElement& element : elements_) sum += lights::projected_area_m2(element, leaving);
    return sum;
}

EmitterPoint EmitterSurface::sample_by_area(const std::array<double, 2>& u) const {
    const auto choice = by_area_.choose(u[0]);
    const EmitterElement& element = elements_[choice.index];
    EmitterPoint point = lights::sample_by_area(element, {choice.remainder, u[1]});
    point.lifted = lifted(element, point.position, point.normal, 0);
    return point;
}

EmitterPoint EmitterSurface::sample_projected(const Vec3& leaving, const std::array<double, 2>& u) const {
    double left = u[0] * projected_area_m2(leaving), share = 0;
    const EmitterElement* chosen = nullptr;
    for (const EmitterElement& element : elements_) {
        const double own = lights::projected_area_m2(element, leaving);
        if (!(own > 0)) continue;
        chosen = &element;
        share = std::min(left / own, math::kBelowOne);
        if (left < own) break;
        left -= own;
    }
    const auto* sphere = std::get_if<Sphere>(&chosen->shape);
    EmitterPoint point = sphere ? sample_disk_of(*sphere, leaving, {share, u[1]})
                                : lights::sample_by_area(*chosen, {share, u[1]});
    point.lifted = lifted(*chosen, point.position, point.normal, 0);
    return point;
}

math::DiscreteChoice EmitterSurface::choose(const Vec3& from, double u) const {
    if (!chooses_facing()) return by_area_.choose(u);
    std::array<double, kFew> sums;
    double total = 0;
    for (std::size_t i = 0; i < elements_.size(); ++i) sums[i] = total += facing_area_m2(elements_[i], from);
    if (!(total > 0)) return {0, 0, 0};
    return math::choose_by_sums({sums.data(), elements_.size()}, u);
}

double EmitterSurface::probability(std::size_t element, const Vec3& from) const {
    if (!chooses_facing()) return by_area_.probability(element);
    double total = 0;
    for (const EmitterElement& other : elements_) total += facing_area_m2(other, from);
    return total > 0 ? facing_area_m2(elements_[element], from) / total : 0;
}

auto EmitterSurface::sample_seen(const Vec3& from, const std::array<double, 2>& u) const
    -> std::optional<SeenPoint> {
    const auto choice = choose(from, u[0]);
    if (!(choice.probability > 0)) return std::nullopt;
    const EmitterElement& element = elements_[choice.index];
    const auto sample = lights::sample_seen(element, from, {choice.remainder, u[1]});
    if (!sample) return std::nullopt;
    const auto& [position, normal, pdf_per_sr] = *sample;
    const Vec3 direction = normalized(position - from);
    // Not >=: where `from` is the sampled point itself, there is no direction to compare.
    if (!(dot(normal, direction) < 0)) return std::nullopt;
    return SeenPoint{lifted(element, position, normal, length(position - from)), direction,
                     pdf_per_sr * choice.probability,
                     choice.probability * lights::rough_pdf_per_sr(element, position, normal, from)};
}

double EmitterSurface::pdf_per_sr(std::uint32_t triangle, const Vec3& position, const Vec3& normal,
                                  const Vec3& from) const {
    const std::size_t element = elements_.size() == 1 ? 0 : triangle;
    return probability(element, from) * lights::rough_pdf_per_sr(elements_[element], position, normal, from);
}

}  // namespace stilb::lights
