// Functions of several quantities that the same replicates estimate, with errors that contain their
// correlation.
#pragma once

#include <span>
#include <vector>

#include "statistics/interval.h"

namespace stilb::statistics {

/// A quantity as a run estimates it.
struct Quantity {
    Estimate estimate;
    std::vector<double> residuals;  ///< of the replicates, to first order; their mean is 0
};

struct Combination {
    Estimate estimate;
    std::vector<double> of_replicates;  ///< to first order; their mean is the value
};

/// The estimate of a function with this value and these slopes, its derivatives by each quantity, at the
/// quantities' values. By the delta method: in replicate r it differs by the sum of slope times residual, so
/// the error contains all correlations. Its interval is Student's t over these differences; what the
/// intervals of the quantities have beyond their own (for rare light, patches, and the selection of minima)
/// is added on the side to which it moves the function. `confidence`: also of the quantities' intervals. At
/// least one quantity, and two replicates.
Combination combine(double value, std::span<const double> slopes, std::span<const Quantity> quantities,
                    double confidence);

}  // namespace stilb::statistics
