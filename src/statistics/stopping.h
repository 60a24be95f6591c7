// When a run is good enough: the stopping rule and how far a run has come.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "statistics/interval.h"

namespace stilb::statistics {

/// Share of each sensor's readings that must meet the target: the few darkest points must not decide over the
/// rest.
inline constexpr double kReadingShare = 0.95;

/// The confidence at which to make the intervals of a run that stops by its own error, for them to hold in 95
/// % of the runs: one stops sooner where the standard error happens to be too small. docs/statistics.md has
/// the measurements.
inline constexpr double kStoppedConfidence = 0.96;

/// The relative half-width that this share of the readings is within; 0 without readings.
double attained_error(std::span<const Estimate> readings, double share = kReadingShare);
double attained_error_of(std::vector<double> relative_half_widths, double share = kReadingShare);
/// That readings with this share of all weight are within; weights are not negative, one for each reading.
double attained_error(std::span<const Estimate> readings, std::span<const double> weights,
                      double share = kReadingShare);

/// How many samples there are at the next look at the errors, after `done`: `first`, then 1.5, 2, 3, 4, 6 ...
/// times as many, where Sobol' points are at their best and the overshoot is at most a half.
std::uint64_t next_look(std::uint64_t done, std::uint64_t first);

}  // namespace stilb::statistics
