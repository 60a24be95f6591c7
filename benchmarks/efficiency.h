// Efficiency 1 / (variance x time) of estimates that are made again and again.
//
// Variance is that of the mean of all rounds, relative to the value squared: its mean over the readings, its
// median, and the square of the error that 95 % of the readings keep, which is what a run stops by.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "estimators/estimator.h"

namespace stilb {

struct Efficiency {
    double by_mean = 0, by_median = 0, by_95_percent = 0;
    double cpu_s = 0;  ///< of all rounds
};

/// Processor time of the program so far, of all its threads.
double processor_s();

/// Estimates every reading in a round, by so many samples. Rounds are independent.
using Measure = std::function<std::vector<double>(std::uint64_t round, std::uint64_t samples)>;

// Both keep a reference to the estimator.

/// All readings [lx or cd/m2].
Measure readings_with(const estimators::Estimator& estimator, math::RandomKey key = math::RandomKey{3});
/// Passes of a picture of that many columns and rows, as its pixels' luminances [cd/m2].
Measure picture_with(const estimators::Estimator& estimator, const std::array<int, 2>& resolution,
                     math::RandomKey key = math::RandomKey{3});

/// Sixteen rounds, each of so many samples, `granularity` times a power of two, that it takes a third of a
/// second.
Efficiency efficiency_of(const Measure& measure, std::uint64_t granularity);

}  // namespace stilb
