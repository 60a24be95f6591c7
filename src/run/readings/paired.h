// Differences of two runs whose replicates belong together, because they have the same seed and samples.
#pragma once

#include "run/result.h"
#include "statistics/grid_summary.h"

namespace stilb::run {

/// The difference of a statistic of a sensor between two results, replicate by replicate: what the noise of
/// both has in common is not in its error. `confidence`: that of the intervals of both. Throws
/// std::invalid_argument where the sensors have other numbers of readings or replicates.
statistics::Estimate paired_difference(const SensorResult& after, const SensorResult& before,
                                       Statistic statistic, double confidence);

}  // namespace stilb::run
