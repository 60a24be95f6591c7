// Ratings of discomfort glare, from the illuminances at eyes.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "math/random.h"
#include "rays/ray_caster.h"
#include "run/result.h"
#include "transport/glare.h"

namespace stilb::run {

/// The Unified Glare Ratings [CIE 117] of a sensor of type "ugr", in place of its illuminances:
///
///     UGR = 8 log10( 0.25 / Lb sum of L^2 w / p^2 ),   Lb = (E - Ed) / pi,
///
/// with the illuminance E at the eye and that by lamps alone, Ed. The interval contains the errors of all
/// three sums. A rating is 0 where the eye sees no lamp, and NaN where there is no background.
SensorResult with_unified_ratings(const SensorResult& illuminances, const Scene& scene,
                                  const rays::RayCaster& caster, double confidence, math::RandomKey key,
                                  std::vector<std::string>& warnings);

/// Of a view: from which luminance on a place is a source of glare, and the sums of L^2 w / p^2 over such
/// places beside lamps, by replicates.
struct BrightParts {
    double threshold_cd_m2 = 0;
    std::array<double, transport::kGlareReplicates> glare_of_replicates{};
};

/// Finds the bright parts in all views of the sensors of type "dgp" (glare_picture.h), sensor by sensor; for
/// other sensors none. Throws Cancelled where the monitor ends the run.
std::vector<std::vector<BrightParts>> find_bright_parts(std::span<const Sensor> sensors, const Scene& scene,
                                                        const rays::RayCaster& caster,
                                                        const RunOptions& options, const Monitor& monitor);

/// The Daylight Glare Probabilities [Wienold, Christoffersen 2006] of a sensor of type "dgp", in place of its
/// illuminances:
///
///     DGP = 5.87e-5 E + 0.0918 log10(1 + sum of L^2 w / (E^1.87 p^2)) + 0.16
///
/// over the lamps above the threshold and the bright parts. The interval contains the errors of E and of the
/// sum. NaN where E is 0.
SensorResult with_daylight_probabilities(const SensorResult& illuminances,
                                         const std::vector<BrightParts>& bright, const Scene& scene,
                                         const rays::RayCaster& caster, double confidence,
                                         math::RandomKey key, std::vector<std::string>& warnings);

}  // namespace stilb::run
