#include "statistics/combination.h"

#include <cmath>
#include <utility>

namespace stilb::statistics {
namespace {

/// The standard error of the mean of replicates.
double error_of(const std::vector<double>& replicates) {
    return compute_replicate_moments({replicates, 1}).errors.standard_errors.front();
}

}  // namespace

Combination combine(double value, std::span<const double> slopes, std::span<const Quantity> quantities,
                    double confidence) {
    std::vector<double> differences(quantities.front().residuals.size());
    const double quantile =
        student_t_quantile((1 + confidence) / 2, static_cast<int>(differences.size()) - 1);
    Margins beyond;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        const auto& [own, residuals] = quantities[i];
        for (std::size_t r = 0; r < differences.size(); ++r) differences[r] += slopes[i] * residuals[r];
        const double slope = slopes[i];
        Margins margins = margins_beyond(own, quantile * error_of(residuals));
        if (slope < 0) std::swap(margins.below, margins.above);
        beyond.below += std::abs(slope) * margins.below;
        beyond.above += std::abs(slope) * margins.above;
    }
    const double error = error_of(differences), half_width = quantile * error;
    for (double& difference : differences) difference += value;
    return {{value, error, value - half_width - beyond.below, value + half_width + beyond.above},
            std::move(differences)};
}

}  // namespace stilb::statistics
