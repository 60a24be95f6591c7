// Bounds of biases that are known from noisy comparisons with an unbiased method.
#pragma once

#include <span>
#include <vector>

#include "statistics/interval.h"

namespace stilb::statistics {

/// Bounds, of about 95 % confidence, of the biases of readings and of their mean.
struct BiasBounds {
    std::vector<double> of_readings;
    double of_mean = 0;
    /// The root mean square over the readings, relative to each; with the same confidence at least, at most.
    double relative_at_least = 0, relative = 0;
};

/// `differences`: what each replicate found a reading to be too low by. `values`: the readings.
///
/// A single comparison is as noisy as the unbiased method. But all readings together tell the mean square of
/// the relative biases far better than each of them its own: it is the mean of the products of the
/// differences of two replicates, whose noise is independent, plus some two of its standard errors. Each
/// reading's bound is this share of it, unless its own difference tells more: that it is more than two of its
/// standard errors, or that the bias is less.
///
/// Throws std::invalid_argument for fewer than two replicates.
BiasBounds bias_bounds(const ReplicateTable& differences, std::span<const double> values);

/// The estimate with an interval that is wider by the bound on both sides.
Estimate widened(const Estimate& estimate, double bound);

}  // namespace stilb::statistics
