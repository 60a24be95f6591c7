#include "statistics/bias.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace stilb::statistics {
namespace {

/// Standard errors that count, for bounds of about 95 % confidence: the distributions are skewed.
constexpr double kErrors = 2.2;

/// Less for readings whose relative differences are far noisier than the others': in the dark. `errors`:
/// relative.
std::vector<double> weights_for(const std::vector<double>& errors) {
    constexpr double kFarNoisier = 3;
    std::vector<double> sorted;
    std::ranges::copy_if(errors, std::back_inserter(sorted), [](double e) { return std::isfinite(e); });
    if (sorted.empty()) return std::vector<double>(errors.size());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double usual = kFarNoisier * *middle;
    std::vector<double> weights;
    for (const double error : errors) {
        weights.push_back(error <= usual ? 1 : std::isfinite(error) ? std::pow(usual / error, 4) : 0);
    }
    return weights;
}

struct Range {
    double least = 0, most = 0;
};

/// The mean square of the relative differences' expectations. From the products of all pairs of
/// different replicates: their mean has no bias, and its variance is that of a U-statistic of degree 2.
Range mean_square(const ReplicateTable& differences, std::span<const double> values,
                  const std::vector<double>& weights) {
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(all > 0)) return {};
    const std::size_t n = differences.replicates();
    const auto product = [&](std::size_t r, std::size_t s) {
        double sum = 0;
        for (std::size_t j = 0; j < values.size(); ++j) {
            if (weights[j] > 0)
                sum += weights[j] * differences.row(r)[j] * differences.row(s)[j] / (values[j] * values[j]);
        }
        return sum / all;
    };
    std::vector<double> of_replicate(n);  // the mean product with the others
    double sum = 0, squares = 0;
    for (std::size_t r = 0; r < n; ++r) {
        for (std::size_t s = 0; s < r; ++s) {
            const double p = product(r, s);
            sum += p;
            squares += p * p;
            of_replicate[r] += p / static_cast<double>(n - 1);
            of_replicate[s] += p / static_cast<double>(n - 1);
        }
    }
    const double count = static_cast<double>(n), pairs = count * (count - 1) / 2, mean = sum / pairs;
    double of_means = 0;
    for (const double m : of_replicate) of_means += (m - mean) * (m - mean) / (count - 1);
    const double variance = 4 * of_means / count + std::max(0.0, squares / pairs - mean * mean) / pairs;
    const double error = kErrors * std::sqrt(variance);
    return {std::max(mean - error, 0.0), std::max(mean, 0.0) + error};
}

}  // namespace

BiasBounds bias_bounds(const ReplicateTable& differences, std::span<const double> values) {
    const ReplicateMoments moments = compute_replicate_moments(differences);
    std::vector<double> relative_errors;
    for (std::size_t j = 0; j < values.size(); ++j)
        relative_errors.push_back(moments.errors.standard_errors[j] / values[j]);
    BiasBounds bounds;
    const Range squared = mean_square(differences, values, weights_for(relative_errors));
    bounds.relative_at_least = std::sqrt(squared.least);
    bounds.relative = std::sqrt(squared.most);
    for (std::size_t j = 0; j < values.size(); ++j) {
        const double own = std::abs(moments.means[j]), error = kErrors * moments.errors.standard_errors[j];
        const double of_all = bounds.relative * values[j];
        bounds.of_readings.push_back(own > error ? own + error : std::min(of_all, own + error));
    }
    // The mean's own bias is known from its own differences; and it is no larger than the readings' ones.
    std::vector<double> of_replicates;
    for (std::size_t r = 0; r < differences.replicates(); ++r) {
        const auto row = differences.row(r);
        of_replicates.push_back(std::accumulate(row.begin(), row.end(), 0.0) /
                                static_cast<double>(values.size()));
    }
    const Estimate mean = estimate_from_replicates(of_replicates);
    const double of_all = std::accumulate(bounds.of_readings.begin(), bounds.of_readings.end(), 0.0) /
                          static_cast<double>(values.size());
    bounds.of_mean = std::min(std::abs(mean.value) + kErrors * mean.standard_error, of_all);
    return bounds;
}

Estimate widened(const Estimate& estimate, double bound) {
    return {estimate.value, estimate.standard_error, estimate.lower - bound, estimate.upper + bound};
}

}  // namespace stilb::statistics
