// A measured value with its error, made from independent replicates. docs/statistics.md says how and how
// well.
#pragma once

#include <cstddef>
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

}  // namespace stilb::statistics
