// Efficiency 1 / (variance x time) of estimates that are made again and again.
//
// Variance is that of the mean of all rounds, relative to the value squared: its mean over the readings, its
// median, and the square of the error that 95 % of the readings keep, which is what a run stops by.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace stilb {

struct Efficiency {
    double by_mean = 0, by_median = 0, by_95_percent = 0;
    double cpu_s = 0;  ///< of all rounds
};

/// What round `round` makes of every reading, by so many samples. Rounds are independent.
using Measure = std::function<std::vector<double>(std::uint64_t round, std::uint64_t samples)>;

/// Sixteen rounds, each of so many samples, `granularity` times a power of two, that it takes a third of a
/// second.
Efficiency efficiency_of(const Measure& measure, std::uint64_t granularity);

}  // namespace stilb
