// Differences of two runs whose replicates belong together, because they have the same seed and samples.
#pragma once

#include <optional>

#include "run/result.h"
#include "statistics/grid_summary.h"

namespace stilb::run {

/// The difference of a statistic of a sensor between two results, replicate by replicate: what the noise of
/// both has in common is not in its error, nor is light so rare that both have missed it. `confidence`: that
/// of the intervals of both. Nothing where the sensors have other numbers of readings or replicates.
std::optional<statistics::Estimate> paired_difference(const SensorResult& after, const SensorResult& before,
                                                      Statistic statistic, double confidence);

}  // namespace stilb::run
