#include "transport/direct/opening_lamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace stilb::transport {
namespace {

/// Surfaces of more elements are sampled.
constexpr std::size_t kMostElements = 64;

/// Rules over (0, 1), each with twice the nodes of the one before.
const std::array<math::GaussLegendre, 4>& rules() {
    static const auto all = [] {
        std::array<math::GaussLegendre, 4> made;
        for (std::size_t k = 0; k < made.size(); ++k) {
            made[k] = math::gauss_legendre(2 << k);
            for (double& node : made[k].nodes) node = (node + 1) / 2;
            for (double& weight : made[k].weights) weight /= 2;
        }
        return made;
    }();
    return all;
}

}  // namespace

std::optional<OpeningLamp> OpeningLamp::of(const Scene& scene, std::size_t light, const LightSampler& lights,
                                           const Lift& lift) {
    const auto object = lights::emitting_object(scene.lights[light]);
    if (!object || lights::uniform_emission(scene.lights[light])) return std::nullopt;
    std::vector<lights::EmitterElement> elements = lights::emitter_elements(scene.object(*object).shape);
    const bool is_flat = std::ranges::all_of(
        elements, [](const lights::EmitterElement& element) { return element.normal.has_value(); });
    if (!is_flat || elements.size() > kMostElements) return std::nullopt;
    return OpeningLamp(light, lights, *object, std::move(elements), lift);
}

bool OpeningLamp::may_light(const SurfacePoint& at) const {
    return std::ranges::any_of(elements_, [&](const lights::EmitterElement& element) {
        return dot(at.position - element.middle, *element.normal) > 0;
    });
}

std::optional<Rgb> OpeningLamp::illuminance_lx(const SurfacePoint& at) const {
    Rgb coarse = sum_lx(at, rules()[0]);
    for (const math::GaussLegendre& rule : std::span(rules()).subspan(1)) {
        const Rgb fine = sum_lx(at, rule);
        if (std::abs(fine.luminance() - coarse.luminance()) < kAgreement * fine.luminance()) return fine;
        coarse = fine;
    }
    return std::nullopt;
}

Rgb OpeningLamp::sum_lx(const SurfacePoint& at, const math::GaussLegendre& rule) const {
    Rgb sum;
    for (const lights::EmitterElement& element : elements_) {
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
                const lights::EmitterPoint point =
                    lights::sample_by_area(element, {rule.nodes[i], rule.nodes[j]});
                const Vec3 towards = point.position - at.position;
                const double squared_m2 = squared_length(towards);
                const Vec3 direction = towards * (1 / std::sqrt(squared_m2));
                const double cosines =
                    std::max(dot(direction, at.normal), 0.0) * std::max(-dot(direction, point.normal), 0.0);
                if (!(cosines > 0)) continue;
                const double area_m2 = rule.weights[i] * rule.weights[j] * point.weight * element.area_m2;
                sum += (area_m2 * cosines / squared_m2) * lights_.front_luminance(light_, -direction);
            }
        }
    }
    return sum;
}

}  // namespace stilb::transport
