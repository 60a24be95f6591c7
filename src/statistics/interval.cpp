
#include "statistics/interval.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"

namespace stilb::statistics {

double student_t_quantile(double probability, int degrees_of_freedom) {
    // In long double, the default, the quantiles took a tenth of the time of a short run.
    using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    const boost::math::students_t_distribution<double, Policy> distribution(degrees_of_freedom);
    return boost::math::quantile(distribution, probability);
}

StudentQuantiles::StudentQuantiles(double probability, std::span<const int> degrees_of_freedom)
    : quantiles_(*std::ranges::max_element(degrees_of_freedom) + 1) {
    for (const int degrees : degrees_of_freedom) {
        if (quantiles_[degrees] == 0) quantiles_[degrees] = student_t_quantile(probability, degrees);
    }
}

std::vector<Estimate> estimate_readings(const ReplicateTable& table, double confidence,
                                        std::span<const double> rare_light) {
    const ReplicateMoments moments = compute_replicate_moments(table);
    const auto& [standard_errors, degrees] = moments.errors;
    std::vector<Estimate> estimates(table.readings);
    if (estimates.empty()) return estimates;
    const StudentQuantiles quantiles((1 + confidence) / 2, degrees);
    for (std::size_t j = 0; j < estimates.size(); ++j) {
        const double half_width = quantiles(degrees[j]) * standard_errors[j];
        const double upper = rare_light.empty() ? half_width : std::hypot(half_width, rare_light[j]);
        estimates[j] = {moments.means[j], standard_errors[j], moments.means[j] - half_width,
                        moments.means[j] + upper};
    }
    return estimates;
}

Estimate estimate_from_replicates(std::span<const double> replicate_means, double confidence,
                                  double rare_light) {
    return estimate_readings({replicate_means, 1}, confidence, {&rare_light, 1}).front();
}

double relative_half_width(const Estimate& estimate, double least) {
    const double half_width = (estimate.upper - estimate.lower) / 2;
    const double value = std::max(std::abs(estimate.value), least);
    if (half_width == 0) return 0;
    if (value == 0) return std::numeric_limits<double>::infinity();
    return half_width / value;
}

double dark_level(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum > 0 ? kDarkShare * sum / static_cast<double>(values.size()) : 0;
}

double dark_level(std::span<const Estimate> readings) {
    std::vector<double> values(readings.size());
    std::ranges::transform(readings, values.begin(), &Estimate::value);
    return dark_level(values);
}

ReplicateMoments compute_replicate_moments(const ReplicateTable& table) {
    const std::size_t replicates = table.replicates();
    if (replicates < 2 || table.means.size() != replicates * table.readings) {
        throw std::invalid_argument("an interval takes at least two replicates of every reading");
    }
    // Measured from the first replicate, so that equal replicates have exactly their mean and an error of
    // exactly 0.
    const std::span<const double> origin = table.row(0);
    std::vector<double> means(table.readings, 0.0);
    parallel_for_parts(means.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t r = 1; r < replicates; ++r) {
            const std::span<const double> row = table.row(r);
            for (std::size_t j = first; j < last; ++j) means[j] += row[j] - origin[j];
        }
        for (std::size_t j = first; j < last; ++j)
            means[j] = origin[j] + means[j] / static_cast<double>(replicates);
    });
    const std::vector<double> slopes(table.readings, 0.0), common(replicates, 0.0);
    PooledErrors<double> errors = residual_errors(table, means, slopes, common);
    return {std::move(means), std::move(errors)};
}

PooledErrors<double> residual_errors(const ReplicateTable& table, std::span<const double> means,
                                     std::span<const double> slopes, std::span<const double> common) {
    std::vector<double> errors(table.readings, 0.0);
    const double replicates = static_cast<double>(table.replicates());
    parallel_for_parts(errors.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t r = 0; r < table.replicates(); ++r) {
            const std::span<const double> row = table.row(r);
            const double shift = common[r];
            for (std::size_t j = first; j < last; ++j) {
                const double residual = row[j] - means[j] - slopes[j] * shift;
                errors[j] += residual * residual;
            }
        }
        for (std::size_t j = first; j < last; ++j)
            errors[j] = std::sqrt(errors[j] / (replicates * (replicates - 1)));
    });
    const int degrees = static_cast<int>(table.replicates()) - 1;
    if (table.columns > 0) return pool_errors<double>(table.columns, means, errors, degrees);
    return {std::move(errors), std::vector<int>(table.readings, degrees)};
}

LargestContributions largest_contributions(std::span<double> of_replicates) {
    const auto middle = of_replicates.begin() + static_cast<std::ptrdiff_t>(of_replicates.size() / 2);
    std::nth_element(of_replicates.begin(), middle, of_replicates.end());
    return {*std::max_element(middle, of_replicates.end()), *middle};
}

double rare_light(const LargestContributions& largest, std::uint64_t samples) {
    constexpr double kMissing = 4;
    return kMissing * (largest.overall - largest.typical) / static_cast<double>(samples);
}

bool rests_on_few_samples(const Estimate& reading, const LargestContributions& largest,
                          std::uint64_t samples) {
    constexpr double kOutstanding = 4, kMostOfReading = 0.02, kMostOfError = 0.7;
    if (largest.overall <= kOutstanding * largest.typical) return false;
    const double count = static_cast<double>(samples);
    const double excess = (largest.overall - largest.typical) / count;
    return excess > std::min(kMostOfReading, 1 / std::sqrt(count)) * reading.value ||
           excess > kMostOfError * reading.standard_error;
}

double attained_error(std::span<const Estimate> readings, double share) {
    const double least = dark_level(readings);
    std::vector<double> half_widths(readings.size());
    std::ranges::transform(readings, half_widths.begin(),
                           [&](const Estimate& estimate) { return relative_half_width(estimate, least); });
    return attained_error_of(std::move(half_widths), share);
}

double attained_error_of(std::vector<double> half_widths, double share) {
    if (half_widths.empty()) return 0;
    // The small number prevents 0.95 * 20 from counting as more than 19.
    const double needed = std::ceil(share * static_cast<double>(half_widths.size()) - 1e-9);
    const auto last =
        half_widths.begin() + std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(needed) - 1, 0);
    std::nth_element(half_widths.begin(), last, half_widths.end());
    return *last;
}

double attained_error_of(std::span<const double> relative_half_widths, std::span<const double> weights,
                         double share) {
    std::vector<std::pair<double, double>> half_widths;  // with their weights
    double needed = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        half_widths.emplace_back(relative_half_widths[i], weights[i]);
        needed += share * weights[i];
    }
    std::sort(half_widths.begin(), half_widths.end());
    double reached = 0;
    for (const auto& [half_width, weight] : half_widths) {
        reached += weight;
        if (reached >= needed) return half_width;
    }
    return half_widths.empty() ? 0 : half_widths.back().first;
}

std::uint64_t next_check(std::uint64_t done, std::uint64_t first) {
    std::uint64_t check = first;
    while (2 * check <= done) check *= 2;
    if (done < check) return check;
    const std::uint64_t half_more = check + check / 2;
    return done < half_more ? half_more : 2 * check;
}

}  // namespace stilb::statistics
