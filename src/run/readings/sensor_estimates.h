// All values of the sensors of a run: readings, summaries, derived values, and whether they meet what is
// required.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "run/readings/campaign.h"
#include "run/result.h"
#include "sensors/sensor.h"
#include "statistics/grid_summary.h"

namespace stilb::run {

/// Of one sensor; of a derived value, a single reading without pooled errors.
struct SensorEstimates {
    Campaign::Estimates readings;
    statistics::GridSummary summary;  ///< intervals with the error of the patches
    /// The same with what the readings leave out, as far as it is known: infinite where it is not. Nothing
    /// where they leave out nothing.
    std::optional<statistics::GridSummary> complete{};
};

/// The summary of a sensor's readings; intervals with the error of the patches.
statistics::GridSummary summary_of(const Campaign::Estimates& estimates, double confidence);

/// One for each sensor of the campaign, in order, with the light of channels by their weights; illuminances
/// for sensors that rate glare (glare.h). Throws InputError where a derived value does not fit.
std::vector<SensorEstimates> estimate_all(const Campaign& campaign, std::span<const Sensor> sensors,
                                          double confidence, ChannelWeights weights = {});

/// The largest relative half-width of the means and minima of sensors with readings; dark minima as dark
/// readings (statistics::dark_level).
double attained_error_of_means(std::span<const Sensor> sensors, std::span<const SensorEstimates> estimates);

/// A requirement is met, or is not, where the whole interval says so.
std::vector<RatedRequirement> rate(std::span<const Requirement> requirements,
                                   const SensorEstimates& estimates);

}  // namespace stilb::run
