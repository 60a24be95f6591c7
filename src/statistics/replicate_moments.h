// Means and standard errors over a table's replicates, all readings at once.
#pragma once

#include <vector>

#include "statistics/interval.h"

namespace stilb::statistics {

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

}  // namespace stilb::statistics
