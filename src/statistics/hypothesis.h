// Statistical tests, one definition each: for the library, the tests and the experiments.
#pragma once

#include <cstddef>
#include <span>

#include "statistics/interval.h"

namespace stilb::statistics {

/// The distance of two independent estimates in standard errors. Without any error: 0 if equal, else
/// infinite.
double z_score(const Estimate& a, const Estimate& b);
/// The distance from a value that is known exactly.
double z_score(const Estimate& estimate, double exact);

/// The probability that a normal deviate is at least this far from 0.
double two_sided_p_of_z(double z);
/// The probability that Student's t is at least this far from 0.
double two_sided_p_of_t(double t, int degrees_of_freedom);

/// The normal z with the same tail as this t. A z-score whose standard error comes from R replicates is a t
/// with R - 1 degrees of freedom: at 15 of them |t| > 4 is 18 times as likely as |z| > 4.
double equivalent_z(double t, int degrees_of_freedom);

/// The |z| that the largest of `comparisons` independent normal deviates exceeds with probability
/// `family_error` (Sidak; somewhat cautious if they are correlated).
double sidak_threshold_z(double family_error, std::size_t comparisons);

struct Chi2Result {
    double statistic = 0;
    int degrees_of_freedom = 0;
    double p_value = 1;
};

/// Pearson's test of counts against expectations with the same total. Bins with expectations below
/// `least_expected` are merged, smallest first, as the distribution of the statistic does not hold for them.
/// A count where exactly nothing is expected gives p = 0. Throws std::invalid_argument where the sizes
/// differ.
Chi2Result chi2_test(std::span<const double> observed, std::span<const double> expected,
                     double least_expected = 5);

/// Kolmogorov-Smirnov: the probability that numbers uniform in [0, 1] deviate from uniformity at least this
/// much. For eight numbers or more (asymptotic distribution with the correction of [Stephens 1970]).
double uniformity_p(std::span<const double> numbers);

}  // namespace stilb::statistics
