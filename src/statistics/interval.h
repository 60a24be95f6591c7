// A measured value with its error, from independent replicates. docs/statistics.md describes method and
// quality.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "statistics/pooled_errors.h"

namespace stilb::statistics {

struct Estimate {
    double value = 0;
    double standard_error = 0;
    double lower = 0, upper = 0;  ///< the interval; it always contains the value

    bool operator==(const Estimate&) const = default;
};
/// The value of what is not defined, such as a ratio to 0.
inline constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
inline constexpr Estimate kUndefinedEstimate{kUndefined, kUndefined, kUndefined, kUndefined};

/// Half the width of the interval.
inline double half_width(const Estimate& estimate) { return (estimate.upper - estimate.lower) / 2; }

/// The means of R independent replicates for each of many readings: row r holds replicate r's mean of every
/// reading. Errors of one replicate's readings may be correlated (they share light paths); those of different
/// replicates may not.
struct ReplicateTable {
    std::span<const double> means;  ///< replicates x readings, row-major
    std::size_t readings = 0;
    /// Where readings lie side by side in so many columns, their errors are pooled (pooled_errors.h); 0: not.
    std::size_t columns = 0;

    std::size_t replicates() const { return readings == 0 ? 0 : means.size() / readings; }
    std::span<const double> row(std::size_t replicate) const {
        return means.subspan(replicate * readings, readings);
    }
};

/// The quantile of Student's t with these degrees of freedom for this probability (0 <
/// probability < 1).
double student_t_quantile(double probability, int degrees_of_freedom);

/// The quantiles of one probability for the degrees of freedom (at least 1) that occur among many.
class StudentQuantiles {
  public:
    StudentQuantiles(double probability, std::span<const int> degrees_of_freedom);
    /// For degrees of freedom that were given.
    double operator()(int degrees_of_freedom) const { return quantiles_[degrees_of_freedom]; }

  private:
    std::vector<double> quantiles_;  ///< by degrees of freedom; 0 for those that do not occur
};

/// Mean, standard error and two-sided Student-t interval, whose upper end allows for rare light (in
/// quadrature). Throws std::invalid_argument for fewer than two replicates.
Estimate estimate_from_replicates(std::span<const double> replicate_means, double confidence = 0.95,
                                  double rare_light = 0);

/// The same for every reading of a table. `rare_light`: one for each reading, or none.
std::vector<Estimate> estimate_readings(const ReplicateTable& table, double confidence = 0.95,
                                        std::span<const double> rare_light = {});

/// Half the interval's width over the value, or over `least` where the value is less: 0 where the width is 0
/// (a dark point is known exactly), infinite where only that is not 0.
double relative_half_width(const Estimate& estimate, double least = 0);

/// Errors of a sensor's readings are relative to this share of their mean at least: those of dark readings
/// are absolute. Points in a cupboard must not decide how long a run takes.
inline constexpr double kDarkShare = 0.01;
double dark_level(std::span<const double> values);
double dark_level(std::span<const Estimate> readings);

/// What an interval has beyond `half_width` on each side, 0 where it is narrower.
struct Margins {
    double below = 0, above = 0;
};
inline Margins margins_beyond(const Estimate& estimate, double half_width) {
    return {std::max(0.0, estimate.value - estimate.lower - half_width),
            std::max(0.0, estimate.upper - estimate.value - half_width)};
}

// Means and standard errors over a table's replicates, all readings at once.

struct ReplicateMoments {
    std::vector<double> means;  ///< one per reading
    PooledErrors<double> errors;
};

/// Throws std::invalid_argument for fewer than two replicates or a table whose size is not a multiple of its
/// readings.
ReplicateMoments compute_replicate_moments(const ReplicateTable& table);

/// Standard errors over the replicates r of the readings' mean residuals (x_rj - mean_j) - slope_j *
/// common_r, where the residuals `common` have mean 0 over the replicates.
PooledErrors<double> residual_errors(const ReplicateTable& table, std::span<const double> means,
                                     std::span<const double> slopes, std::span<const double> common);

// Rare contributions: light that few samples find. Replicates tell little about it: those that contain no
// such sample agree with each other, and their mean is too low. The largest contribution of each replicate
// tells more. docs/statistics.md has the measurements behind the constants.

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

// The stopping rule: when a run is accurate enough, and its progress.

/// Share of each sensor's readings that must meet the target: the few darkest points must not decide over the
/// rest.
inline constexpr double kReadingShare = 0.95;

/// The confidence of the intervals of a run that stops by its own error, so that they hold in 95
/// % of the runs: a run stops sooner where the standard error happens to be too small. docs/statistics.md has
/// the measurements.
inline constexpr double kStoppedConfidence = 0.96;

/// The confidence of the intervals by which a run decides what is required as it goes on. It looks again and
/// again, each time with a chance to be wrong, so they are wider than those of results. docs/statistics.md
/// has the measurements.
inline constexpr double kVerdictConfidence = 0.998;

/// The confidence of the intervals of a run that stopped by such a decision, so that they hold in 95 % of the
/// runs: it stops sooner where a value happens to be far from what is required.
inline constexpr double kDecidedConfidence = 0.98;

/// The relative half-width, of dark readings that over dark_level(), that this share of a sensor's readings
/// meets; 0 without readings.
double attained_error(std::span<const Estimate> readings, double share = kReadingShare);
double attained_error_of(std::vector<double> relative_half_widths, double share = kReadingShare);
/// The half-width that readings with this share of all weight meet; weights are not negative, one for each
/// reading.
double attained_error_of(std::span<const double> relative_half_widths, std::span<const double> weights,
                         double share = kReadingShare);

/// The number of samples at the next error estimate, after `done`: `first`, then 1.5, 2, 3, 4, 6 ...
/// times as many, where Sobol' points are at their best and the overshoot is at most a half.
std::uint64_t next_check(std::uint64_t done, std::uint64_t first);

}  // namespace stilb::statistics
