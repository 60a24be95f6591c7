#include "transport/weak_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "transport/light_sampler.h"

namespace stilb::transport {
namespace {

/// Lights of so much less than the strongest one are weak.
constexpr double kComparable = 16;
/// Particles of each light that is asked, and such lights of each strength; fewer where lights are so many
/// that estimates would take seconds.
constexpr std::size_t kParticlesOfLight = 16, kAsked = 16, kMostEstimates = 20'000'000;

/// Lights of about the same strength, up to a factor of 2.
struct Strength {
    double most = 0, sum = 0;
    std::vector<std::size_t> lights;
};

/// The weakest first; without those of no light.
std::vector<Strength> by_strength(std::span<const double> weights, std::span<const double> strengths) {
    std::map<int, Strength> all;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!(weights[i] > 0)) continue;
        Strength& own = all[std::ilogb(strengths[i])];
        own.most = std::max(own.most, strengths[i]);
        own.sum += weights[i];
        own.lights.push_back(i);
    }
    std::vector<Strength> sorted;
    for (auto& [exponent, strength] : all) sorted.push_back(std::move(strength));
    return sorted;
}

/// The estimates of all lights over those of the lights that are not stronger than `most_lm`: as large as
/// this or smaller on nine tenths of the first surfaces of a light; 1 where it meets none. A median would not
/// do: where a strong light is on one side, half of the surfaces turn away from it.
double largest_excess(std::size_t light, double most_lm, const LightSampler& lights,
                      std::span<const double> flux_lm, const rays::RayCaster& caster) {
    std::vector<double> excesses;
    for (std::uint64_t i = 0; i < kParticlesOfLight; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const lights::Emission particle = lights.emit(light, stream);
        const auto hit = caster.closest(particle.origin, particle.direction);
        if (!hit) continue;
        double all_lx = 0, weak_lx = 0;
        for (std::size_t other = 0; other < lights.count(); ++other) {
            const double rough_lx = lights.rough_illuminance_lx(other, *hit);
            all_lx += rough_lx;
            if (flux_lm[other] > 0 && flux_lm[other] <= most_lm) weak_lx += rough_lx;
        }
        if (weak_lx > 0) excesses.push_back(all_lx / weak_lx);
    }
    if (excesses.empty()) return 1;
    const auto found = excesses.begin() + static_cast<std::ptrdiff_t>(excesses.size() * 9 / 10);
    std::ranges::nth_element(excesses, found);
    return *found;
}

}  // namespace

std::vector<double> emission_favours(std::span<const double> weights, std::span<const double> strengths) {
    std::vector<double> favours(weights.size(), 1);
    const std::vector<Strength> sorted = by_strength(weights, strengths);
    double all = 0, not_stronger = 0;
    for (const Strength& strength : sorted) all += strength.sum;
    for (const Strength& strength : sorted) {
        not_stronger += strength.sum;
        if (sorted.back().most <= kComparable * strength.most) break;
        for (const std::size_t light : strength.lights)
            favours[light] = std::max(1.0, kWeakShare * all / not_stronger);
    }
    return favours;
}

std::vector<double> choice_favours(const LightSampler& lights, std::span<const double> flux_lm,
                                   const rays::RayCaster& caster) {
    std::vector<double> favours(lights.count(), 1);
    const std::vector<Strength> strengths = by_strength(flux_lm, flux_lm);
    const std::size_t most_asked = std::clamp<std::size_t>(
        kMostEstimates / (kParticlesOfLight * lights.count() * std::max<std::size_t>(strengths.size(), 1)), 1,
        kAsked);
    for (const Strength& strength : strengths) {
        const bool is_weak =
            lights.has_light_from_outside() || strengths.back().most > kComparable * strength.most;
        if (!is_weak) break;
        const std::size_t asked = std::min(strength.lights.size(), most_asked);
        double excess = 1;
        for (std::size_t i = 0; i < asked; ++i) {
            const std::size_t light = strength.lights[i * strength.lights.size() / asked];
            excess = std::max(excess, largest_excess(light, strength.most, lights, flux_lm, caster));
        }
        for (const std::size_t light : strength.lights) favours[light] = std::max(1.0, kWeakChoice * excess);
    }
    return favours;
}

}  // namespace stilb::transport
