// A measured value with its error, made from independent replicates. docs/statistics.md says how and how
// well.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stilb::statistics {

struct Estimate {
    double value = 0;
    double standard_error = 0;
    double lower = 0, upper = 0;  ///< the interval; it always contains the value

    bool operator==(const Estimate&) const = default;
};

/// What R independent replicates say of each of many readings: row r holds replicate r's mean of every
/// reading. Errors of one replicate's readings may be correlated (they share chains); those of different
/// replicates may not.
struct ReplicateTable {
    std::span<const double> means;  ///< replicates x readings, row-major
    std::size_t readings = 0;

    std::size_t replicates() const { return readings == 0 ? 0 : means.size() / readings; }
    std::span<const double> row(std::size_t replicate) const {
        return means.subspan(replicate * readings, readings);
    }
};

/// The number that Student's t with these degrees of freedom stays below with this probability (0 <
/// probability < 1).
double student_t_quantile(double probability, int degrees_of_freedom);

/// Mean, standard error and two-sided Student-t interval. Throws std::invalid_argument for fewer than two
/// replicates.
Estimate estimate_from_replicates(std::span<const double> replicate_means, double confidence = 0.95);

/// A value whose error nobody knows: the others are NaN.
Estimate without_error(double value);

/// The same for every reading of a table.
std::vector<Estimate> estimate_readings(const ReplicateTable& table, double confidence = 0.95);

/// Half the interval's width over the value: 0 where both are 0 (a dark point is known exactly), infinite
/// where only the value is 0.
double relative_half_width(const Estimate& estimate);

// Means and standard errors over a table's replicates, all readings at once.

struct ReplicateMoments {
    std::vector<double> means, standard_errors;  ///< one per reading
};

/// Throws std::invalid_argument for fewer than two replicates or a table whose size is no multiple of its
/// readings.
ReplicateMoments compute_replicate_moments(const ReplicateTable& table);

/// Standard errors over the replicates r of the readings' mean residuals (x_rj - mean_j) - slope_j *
/// common_r, where the residuals `common` have mean 0 over the replicates.
std::vector<double> residual_standard_errors(const ReplicateTable& table, std::span<const double> means,
                                             std::span<const double> slopes, std::span<const double> common);

// Whether single contributions carry so much of a sum that its interval cannot be trusted.

/// The share of a sum of `count` independent contributions that its largest one may have: 1/sqrt(count).
///
/// Where the contributions' variance is finite, the largest one's share times sqrt(count) falls to 0 as they
/// become more; where it is infinite (tails of index below 2, such as local estimation has in corners), it
/// grows without limit. At this share the largest contribution alone moves the sum by the standard error of
/// contributions that vary as much as their mean. A fixed share would miss slowly converging sums at large
/// counts and blame small counts for nothing.
inline double heavy_tail_share(std::uint64_t count) { return 1 / std::sqrt(static_cast<double>(count)); }

/// Whether the result deserves a warning. A sum of 0 does not; `count` counts the contributions that are 0
/// too.
inline bool is_heavy_tailed(double largest, double sum, std::uint64_t count) {
    return std::abs(largest) > heavy_tail_share(count) * std::abs(sum);
}

// When a run is good enough: the stopping rule and how far a run has come.

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
