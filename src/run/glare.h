// Ratings of discomfort glare, from the illuminances at eyes.
#pragma once

#include <string>
#include <vector>

#include "math/random.h"
#include "rays/ray_caster.h"
#include "run/result.h"

namespace stilb::run {

/// The Unified Glare Ratings [CIE 117] of a sensor of type "ugr", in place of its illuminances:
///
///     UGR = 8 log10( 0.25 / Lb sum of L^2 w / p^2 ),   Lb = (E - Ed) / pi,
///
/// with the illuminance E at the eye and that by lamps alone, Ed. The interval contains the errors of all
/// three sums. A rating is 0 where the eye sees no lamp, and NaN where there is no background.
SensorResult with_glare_ratings(const SensorResult& illuminances, const Scene& scene,
                                const rays::RayCaster& caster, double confidence, math::RandomKey key,
                                std::vector<std::string>& warnings);

}  // namespace stilb::run
