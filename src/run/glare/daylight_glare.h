// The Daylight Glare Probability [Wienold, Christoffersen 2006]:
//
//     DGP = 5.87e-5 E + 0.0918 log10(1 + sum of L^2 w / (E^1.87 p^2)) + 0.16
//
// with the illuminance E at the eye, over the lamps above a threshold and the bright places beside lamps.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "run/glare/glare_picture.h"
#include "run/readings/sensor_estimates.h"
#include "transport/glare/glare.h"

namespace stilb::run {

/// The lamps and bright places that an eye sees.
struct DaylightView {
    transport::Glare lamps;      ///< by kGlareReplicates samples
    double threshold_cd_m2 = 0;  ///< from here on a place is a source of glare
    /// The sums of L^2 w / p^2 over such places beside lamps, by replicates of a picture.
    std::array<double, kGlareReplicates> bright{};
};

/// By a picture of the view (glare_picture.h). Throws Cancelled where the monitor ends the run.
DaylightView find_daylight_glare(const MeasuringPoint& eye, std::optional<double> threshold_cd_m2,
                                 const PictureSetting& setting, const transport::LightSampler& lights,
                                 math::RandomKey key);

/// Makes the illuminances at the eyes into probabilities, with the errors of E and of the sum. NaN where E is
/// 0.
void rate_daylight(std::span<const DaylightView> views, double confidence, SensorEstimates& estimates);

/// Below this illuminance the probability was not made.
inline constexpr double kLeastDaylight_lx = 380;

}  // namespace stilb::run
