#include "transport/direct/opening_lamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <variant>

namespace stilb::transport {
namespace {

/// Openings of more elements are sampled.
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

std::optional<OpeningLamp> OpeningLamp::of(const Scene& scene, const Light& light, const Lift& lift) {
    const auto* opening = std::get_if<LuminousOpening>(&light.source);
    if (opening == nullptr) return std::nullopt;
    OpeningLamp lamp(scene, *opening, lift);
    const bool is_flat = std::ranges::all_of(
        lamp.elements_, [](const lights::EmitterElement& element) { return element.normal.has_value(); });
    if (!is_flat || lamp.elements_.size() > kMostElements) return std::nullopt;
    return lamp;
}

OpeningLamp::OpeningLamp(const Scene& scene, const LuminousOpening& opening, const Lift& lift)
    : emitter_(opening, scene::LightSurroundings(scene), lift),
      elements_(lights::emitter_elements(scene.object(opening.object).shape)),
      hull_(opening.object, elements_, lift) {}

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
                sum += (area_m2 * cosines / squared_m2) * emitter_.luminance_cd_m2(-direction);
            }
        }
    }
    return sum;
}

std::optional<LampSample> OpeningLamp::sample(const SurfacePoint& at, math::SampleStream& stream) const {
    const auto incident = emitter_.sample_incident(at, stream.next_two());
    return incident ? lamp_sample(*incident, at.normal) : std::nullopt;
}

}  // namespace stilb::transport
