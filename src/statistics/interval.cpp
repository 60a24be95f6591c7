#include "statistics/interval.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "statistics/replicate_moments.h"

namespace stilb::statistics {

double student_t_quantile(double probability, int degrees_of_freedom) {
    return boost::math::quantile(boost::math::students_t(degrees_of_freedom), probability);
}

std::vector<Estimate> estimate_readings(const ReplicateTable& table, double confidence) {
    const ReplicateMoments moments = compute_replicate_moments(table);
    const double quantile =
        student_t_quantile(1 - (1 - confidence) / 2, static_cast<int>(table.replicates()) - 1);
    std::vector<Estimate> estimates(table.readings);
    for (std::size_t j = 0; j < estimates.size(); ++j) {
        const double half_width = quantile * moments.standard_errors[j];
        estimates[j] = {moments.means[j], moments.standard_errors[j], moments.means[j] - half_width,
                        moments.means[j] + half_width};
    }
    return estimates;
}

Estimate estimate_from_replicates(std::span<const double> replicate_means, double confidence) {
    return estimate_readings({replicate_means, 1}, confidence).front();
}

Estimate without_error(double value) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {value, unknown, unknown, unknown};
}

double relative_half_width(const Estimate& estimate) {
    const double half_width = (estimate.upper - estimate.lower) / 2;
    if (half_width == 0) return 0;
    if (estimate.value == 0) return std::numeric_limits<double>::infinity();
    return half_width / std::abs(estimate.value);
}

}  // namespace stilb::statistics
