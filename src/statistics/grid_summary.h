// Mean, minimum, maximum, uniformity and diversity of a grid of readings, each with a valid interval.
#pragma once

#include <vector>

#include "base/statistic.h"
#include "statistics/interval.h"

namespace stilb::statistics {

struct GridSummary {
    Estimate mean, minimum, maximum;
    Estimate uniformity;  ///< minimum over mean; all NaN where the mean is 0, because uniformity is undefined
                          ///< in darkness
    Estimate diversity{};  ///< minimum over maximum; likewise

    const Estimate& operator[](Statistic statistic) const;
};

/// The summary of a table with at least two replicates and one reading; all readings have equal weight in the
/// mean. The values of minimum, maximum and uniformity are the plain ones of the readings' means, and their
/// standard errors those of the selected readings; because such a selection is biased outwards, their
/// intervals are simultaneous ones over all readings that cannot be excluded. Valid for any correlation among
/// the readings; the memory is proportional to the readings. `rare_light`: one for each reading, or none.
/// Throws std::invalid_argument for fewer than two replicates.
GridSummary summarize_grid(const ReplicateTable& table, double confidence = 0.95,
                           std::span<const double> rare_light = {});

// Residuals: by how much each replicate differs from the value, to first order. Their mean is 0.

std::vector<double> residuals_of_reading(const ReplicateTable& table, std::size_t reading);
/// Of the summary's value; minimum and maximum are the selected readings. NaN where the value is.
std::vector<double> residuals_of(const ReplicateTable& table, Statistic statistic);

}  // namespace stilb::statistics
