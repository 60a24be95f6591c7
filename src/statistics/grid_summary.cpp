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
//
// The diversity, minimum over maximum, is the minimum of the readings over the one that is selected as the
// largest. What the interval of the maximum has beyond a plain one is added, because the true maximum may be
// another reading.
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

/// The reading with the least or the largest mean; the first of several.
std::size_t index_of(Extreme extreme, std::span<const double> means) {
    const auto found =
        extreme == Extreme::minimum ? std::ranges::min_element(means) : std::ranges::max_element(means);
    return static_cast<std::size_t>(found - means.begin());
}

class ExtremeFinder {
  public:
    ExtremeFinder(const ReplicateTable& table, const ReplicateMoments& moments, Extreme extreme,
                  double confidence)
        : sign_(sign_of(extreme)), error_rate_(1 - confidence), selected_(index_of(extreme, moments.means)) {
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

    std::size_t selected() const { return selected_; }
    /// What the interval of the extreme has beyond that of one reading with this error.
    Margins beyond_one_reading(const Estimate& extreme, const PooledErrors<double>& errors) const {
        const StudentQuantiles outward = quantiles(kSideShare * error_rate_, errors);
        return margins_beyond(extreme,
                              outward(errors.degrees_of_freedom[selected_]) * extreme.standard_error);
    }

  private:
    void screen(const ReplicateTable& table, std::span<const double> means) {
        const std::vector<double> selected_residuals = residuals_of_reading(table, selected_);
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
        return {1 - tail, errors.degrees_of_freedom};
    }

    double sign_;
    double error_rate_;
    std::size_t selected_;
    std::vector<std::size_t> contenders_;
};

/// The least reading over a denominator X. Its errors follow by the delta method: x_j / X moves by
/// (dx_j - (x_j / X) dX) / X, with the residuals dX of X.
Estimate estimate_ratio(const ReplicateTable& table, std::span<const double> means, double denominator,
                        std::span<const double> residuals, const ExtremeFinder& smallest,
                        std::span<const double> rare_light) {
    if (!(denominator > 0)) return kUndefinedEstimate;
    std::vector<double> ratios(means.begin(), means.end());
    for (double& ratio : ratios) ratio /= denominator;
    PooledErrors<double> errors = residual_errors(table, means, ratios, residuals);
    for (double& error : errors.standard_errors) error /= denominator;
    std::vector<double> missing(rare_light.begin(), rare_light.end());
    for (double& light : missing) light /= denominator;
    return smallest.estimate(ratios, errors, missing);
}

Estimate estimate_diversity(const ReplicateTable& table, const ReplicateMoments& moments,
                            const Estimate& maximum, const ExtremeFinder& smallest,
                            const ExtremeFinder& largest, std::span<const double> rare_light) {
    const std::vector<double> residuals = residuals_of_reading(table, largest.selected());
    Estimate diversity = estimate_ratio(table, moments.means, maximum.value, residuals, smallest, rare_light);
    const Margins margins = largest.beyond_one_reading(maximum, moments.errors);
    diversity.lower -= diversity.value * margins.above / maximum.value;
    diversity.upper += diversity.value * margins.below / maximum.value;
    return diversity;
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

/// Takes the mean away from the values of the replicates, and returns it.
double take_mean(std::vector<double>& values) {
    const double mean = compute_replicate_moments({values, 1}).means.front();
    for (double& value : values) value -= mean;
    return mean;
}

}  // namespace

const Estimate& GridSummary::operator[](Statistic statistic) const {
    switch (statistic) {
        case Statistic::mean:
            return mean;
        case Statistic::minimum:
            return minimum;
        case Statistic::maximum:
            return maximum;
        case Statistic::uniformity:
            return uniformity;
        case Statistic::diversity:
            break;
    }
    return diversity;
}

GridSummary summarize_grid(const ReplicateTable& table, double confidence,
                           std::span<const double> rare_light) {
    const ReplicateMoments moments = compute_replicate_moments(table);
    std::vector<double> grid_means = compute_grid_means(table);
    const ExtremeFinder smallest(table, moments, Extreme::minimum, confidence);
    const ExtremeFinder largest(table, moments, Extreme::maximum, confidence);

    GridSummary summary;
    // The same samples may be missing at all readings.
    const double missing = std::accumulate(rare_light.begin(), rare_light.end(), 0.0) /
                           static_cast<double>(std::max<std::size_t>(rare_light.size(), 1));
    summary.mean = estimate_from_replicates(grid_means, confidence, missing);
    summary.minimum = smallest.estimate(moments.means, moments.errors, rare_light);
    summary.maximum = largest.estimate(moments.means, moments.errors, rare_light);
    take_mean(grid_means);
    summary.uniformity =
        estimate_ratio(table, moments.means, summary.mean.value, grid_means, smallest, rare_light);
    summary.diversity = estimate_diversity(table, moments, summary.maximum, smallest, largest, rare_light);
    // No minimum exceeds the mean or the maximum.
    summary.uniformity.upper = std::min(summary.uniformity.upper, 1.0);
    summary.diversity.upper = std::min(summary.diversity.upper, 1.0);
    return summary;
}

std::vector<double> residuals_of_reading(const ReplicateTable& table, std::size_t reading) {
    std::vector<double> residuals(table.replicates());
    for (std::size_t r = 0; r < residuals.size(); ++r) residuals[r] = table.row(r)[reading];
    take_mean(residuals);
    return residuals;
}

std::vector<double> residuals_of(const ReplicateTable& table, Statistic statistic) {
    const std::vector<double> means = compute_replicate_moments(table).means;
    const std::size_t least = index_of(Extreme::minimum, means), most = index_of(Extreme::maximum, means);
    if (statistic == Statistic::minimum) return residuals_of_reading(table, least);
    if (statistic == Statistic::maximum) return residuals_of_reading(table, most);
    std::vector<double> of_mean = compute_grid_means(table);
    const double mean = take_mean(of_mean);
    if (statistic == Statistic::mean) return of_mean;
    const bool is_diversity = statistic == Statistic::diversity;
    const double denominator = is_diversity ? means[most] : mean;
    const std::vector<double> of_denominator = is_diversity ? residuals_of_reading(table, most) : of_mean;
    std::vector<double> residuals = residuals_of_reading(table, least);
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        residuals[r] = denominator > 0
                           ? (residuals[r] - means[least] / denominator * of_denominator[r]) / denominator
                           : kUndefined;
    }
    return residuals;
}

}  // namespace stilb::statistics
