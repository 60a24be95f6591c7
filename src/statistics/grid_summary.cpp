// The smallest of the true values, theta, is that of an unknown reading i. With v_j, s_j the readings' means
// and standard errors, at a total error rate of alpha = 1 - confidence:
//
// Screening (alpha / 10): a reading is excluded where its paired difference from the reading with the
// smallest mean is significant at the Bonferroni level over all readings. Only comparisons of i itself can
// exclude i wrongly, one with each other reading, so this also holds although the data choose the reading
// compared with.
//
// Lower bound (0.45 alpha): the least v_j - c s_j over the contenders. It fails only if v_i - c s_i > theta,
// an event of one reading: c is the plain t quantile, however many contenders there are.
//
// Upper bound (0.45 alpha): the least v_j + c s_j. It fails if any contender's v_j + c s_j < theta <= mu_j,
// its true value: c is the Bonferroni quantile over the contenders. That the data choose their number is
// covered by measurement (docs/statistics.md), not by this argument.
//
// Bonferroni, because the correlation of the readings' errors is unknown. The maximum is the minimum of the
// negatives.
#include "statistics/grid_summary.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "statistics/interval.h"

namespace stilb::statistics {
namespace {

constexpr double kScreeningShare = 0.1;  ///< of the total error rate
constexpr double kSideShare = 0.45;      ///< of the total error rate, for each end of the interval

enum class Extreme { minimum, maximum };

double sign_of(Extreme extreme) { return extreme == Extreme::minimum ? 1 : -1; }

class ExtremeFinder {
  public:
    ExtremeFinder(const ReplicateTable& table, const ReplicateMoments& moments, Extreme extreme,
                  double confidence)
        : sign_(sign_of(extreme)), error_rate_(1 - confidence) {
        select(moments.means);
        screen(table, moments.means);
    }

    /// The interval of the extreme of quantities that are in the same order as the readings.
    Estimate estimate(std::span<const double> values, const PooledErrors<double>& errors,
                      std::span<const double> rare_light) const {
        const double contenders = static_cast<double>(contenders_.size());
        const StudentQuantiles outward = quantiles(kSideShare * error_rate_, errors);
        const StudentQuantiles inward = quantiles(kSideShare * error_rate_ / contenders, errors);
        const bool is_minimum = sign_ > 0;
        double lower = sign_ * std::numeric_limits<double>::infinity();
        double upper = lower;
        const auto take = [&](double& end, double candidate) {
            end = is_minimum ? std::min(end, candidate) : std::max(end, candidate);
        };
        for (const std::size_t j : contenders_) {
            const double missing = rare_light.empty() ? 0 : rare_light[j];
            const double error = errors.standard_errors[j];
            const int degrees = errors.degrees_of_freedom[j];
            take(lower, values[j] - (is_minimum ? outward : inward)(degrees)*error);
            take(upper, values[j] + std::hypot((is_minimum ? inward : outward)(degrees)*error, missing));
        }
        return {values[selected_], errors.standard_errors[selected_], lower, upper};
    }

  private:
    void select(std::span<const double> means) {
        for (std::size_t j = 1; j < means.size(); ++j) {
            if (sign_ * means[j] < sign_ * means[selected_]) selected_ = j;
        }
    }

    void screen(const ReplicateTable& table, std::span<const double> means) {
        std::vector<double> selected_residuals(table.replicates());
        for (std::size_t r = 0; r < selected_residuals.size(); ++r) {
            selected_residuals[r] = table.row(r)[selected_] - means[selected_];
        }
        const std::vector<double> slopes(table.readings, 1.0);
        const PooledErrors<double> paired = residual_errors(table, means, slopes, selected_residuals);
        const StudentQuantiles strict =
            quantiles(kScreeningShare * error_rate_ / static_cast<double>(table.readings), paired);
        for (std::size_t j = 0; j < table.readings; ++j) {
            const double behind = sign_ * (means[j] - means[selected_]);
            if (behind <= strict(paired.degrees_of_freedom[j]) * paired.standard_errors[j])
                contenders_.push_back(j);
        }
    }

    static StudentQuantiles quantiles(double tail, const PooledErrors<double>& errors) {
        return {1 - tail, *std::ranges::max_element(errors.degrees_of_freedom)};
    }

    double sign_;
    double error_rate_;
    std::size_t selected_ = 0;
    std::vector<std::size_t> contenders_;
};

/// The uniformity's errors by the delta method: x_j / X moves by (dx_j - (x_j / X) dX) / X.
Estimate estimate_uniformity(const ReplicateTable& table, std::span<const double> means,
                             std::span<const double> grid_means, const Estimate& mean,
                             const ExtremeFinder& smallest, std::span<const double> rare_light) {
    if (!(mean.value > 0)) {
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        return {kNone, kNone, kNone, kNone};
    }
    std::vector<double> ratios(means.begin(), means.end());
    for (double& ratio : ratios) ratio /= mean.value;
    std::vector<double> mean_residuals(grid_means.begin(), grid_means.end());
    for (double& residual : mean_residuals) residual -= mean.value;
    PooledErrors<double> errors = residual_errors(table, means, ratios, mean_residuals);
    for (double& error : errors.standard_errors) error /= mean.value;
    std::vector<double> missing(rare_light.begin(), rare_light.end());
    for (double& light : missing) light /= mean.value;
    Estimate uniformity = smallest.estimate(ratios, errors, missing);
    uniformity.upper = std::min(uniformity.upper, 1.0);  // no minimum exceeds the mean
    return uniformity;
}

std::vector<double> compute_grid_means(const ReplicateTable& table) {
    std::vector<double> grid_means(table.replicates());
    for (std::size_t r = 0; r < grid_means.size(); ++r) {
        double sum = 0;
        for (const double value : table.row(r)) sum += value;
        grid_means[r] = sum / static_cast<double>(table.readings);
    }
    return grid_means;
}

}  // namespace

GridSummary summarize_grid(const ReplicateTable& table, double confidence,
                           std::span<const double> rare_light) {
    const ReplicateMoments moments = compute_replicate_moments(table);
    const std::vector<double> grid_means = compute_grid_means(table);
    const ExtremeFinder smallest(table, moments, Extreme::minimum, confidence);
    const ExtremeFinder largest(table, moments, Extreme::maximum, confidence);

    GridSummary summary;
    // The same samples may be missing at all readings.
    const double missing = std::accumulate(rare_light.begin(), rare_light.end(), 0.0) /
                           static_cast<double>(std::max<std::size_t>(rare_light.size(), 1));
    summary.mean = estimate_from_replicates(grid_means, confidence, missing);
    summary.minimum = smallest.estimate(moments.means, moments.errors, rare_light);
    summary.maximum = largest.estimate(moments.means, moments.errors, rare_light);
    summary.uniformity =
        estimate_uniformity(table, moments.means, grid_means, summary.mean, smallest, rare_light);
    return summary;
}

}  // namespace stilb::statistics
