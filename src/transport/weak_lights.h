// Lights that are much weaker than others get more samples than their share of the light: they may be the
// only ones that reach a reading, like an exit sign in a closed stairwell beside a hall, or beside the sky.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rays/ray_caster.h"

namespace stilb::transport {

class LightSampler;

/// Factors of the lights' shares of emitted particles, so that those of each strength and all weaker ones
/// together get about kWeakShare of them, or more. 1 for lights that are comparable with the strongest one.
/// `weights`: not negative. `strengths`: the same, where they say how strong each light is.
std::vector<double> emission_favours(std::span<const double> weights, std::span<const double> strengths);
inline std::vector<double> emission_favours(std::span<const double> weights) {
    return emission_favours(weights, weights);
}

/// Likewise where the light of each strength arrives: nine tenths of its first surfaces choose it, or one
/// that is not stronger, with a probability of about kWeakChoice or more. Particles of some lights of each
/// strength find these surfaces: surfaces that hide the stronger lights are not asked for. `lights`: without
/// favours so far. `flux_lm`: 0 for lights that need no favour, such as light from infinity.
std::vector<double> choice_favours(const LightSampler& lights, std::span<const double> flux_lm,
                                   const rays::RayCaster& caster);

/// A fourth of the choices costs other lights little, because shadow rays are many, and the variance of their
/// light grows by a third at most; light paths are dearer.
inline constexpr double kWeakShare = 0.1, kWeakChoice = 0.25;

}  // namespace stilb::transport
