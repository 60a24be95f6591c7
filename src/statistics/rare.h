// Rare contributions: light that few samples find. Replicates tell little about it: those that contain no
// such sample agree with each other, and their mean is too low. The largest contribution of each replicate
// tells more. docs/statistics.md has the measurements behind the constants.
#pragma once

#include <cstdint>
#include <span>

#include "statistics/interval.h"

namespace stilb::statistics {

/// The largest single contributions to the sum of a reading.
struct LargestContributions {
    double overall = 0;  ///< in all replicates
    double typical = 0;  ///< the median of the replicates' largest ones
};

/// `of_replicates`: the largest contribution of each, at least one; they are reordered.
LargestContributions largest_contributions(std::span<double> of_replicates);

/// How far above its value the interval of a reading must reach for contributions that may be missing: four
/// contributions as large as the largest one exceeds the typical one. Where such contributions come once,
/// twice or four times in a run, a Poisson distribution with an expectation 4.6, 5.2 or 6.2 higher has a
/// probability of 2.5 % of so few; with the replicates' part in quadrature, four give 4.5, 4.9 and 5.7.
/// `samples`: of all replicates.
double rare_light(const LargestContributions& largest, std::uint64_t samples);

/// Whether the interval of a reading cannot be trusted, because the reading and its error depend on the few
/// samples that happened to be drawn: one contribution is more than four times the typical one, and its
/// excess is more than 2 % of the reading, more than 0.7 of its standard error, or a larger share of n
/// samples than 1/sqrt(n). The last test finds infinite variance: with a finite one, the largest share times
/// sqrt(n) falls towards 0 as n grows; with an infinite one it grows without limit.
bool rests_on_few_samples(const Estimate& reading, const LargestContributions& largest,
                          std::uint64_t samples);

}  // namespace stilb::statistics
