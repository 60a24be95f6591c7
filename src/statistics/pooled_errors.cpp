#include "statistics/pooled_errors.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/parallel.h"

namespace stilb::statistics {
namespace {

/// Neighbours to each side that help.
constexpr std::size_t kReach = 2;
/// Degrees of freedom for which the neighbours count at most: their errors are not independent, because they
/// share samples.
constexpr double kMostPrior = 20;

/// Relative variances; 0 where the value is not positive.
template <typename Real>
std::vector<double> relative_variances(std::span<const Real> values, std::span<const Real> standard_errors) {
    std::vector<double> variances(values.size());
    parallel_for_parts(values.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const double relative = double{standard_errors[i]} / double{values[i]};
            variances[i] = values[i] > 0 ? relative * relative : 0;
        }
    });
    return variances;
}

struct Pooled {
    double variance;  ///< relative
    double degrees;
};

/// `own`, `mean`: relative variances; `ratio`: the mean square of those around over the squared mean.
Pooled pooled(double own, double mean, double ratio, double degrees) {
    // By chance alone, the ratio is 1 + 2 / degrees. Beyond that it is the squared coefficient of variation
    // of the true variances, 2 / d0 if they scatter like a mean of d0 squares.
    const double excess = ratio / (1 + 2 / degrees) - 1;
    const double prior = excess > 0 ? std::min(kMostPrior, 2 / excess) : kMostPrior;
    return {(prior * mean + degrees * own) / (prior + degrees), prior + degrees};
}

}  // namespace

template <typename Real>
PooledErrors<Real> pool_errors(std::size_t width, std::span<const Real> values,
                               std::span<const Real> standard_errors, int degrees_of_freedom) {
    if (width == 0 || values.size() % width != 0 || values.size() != standard_errors.size())
        throw std::invalid_argument("pool_errors(): whole rows of values and errors are needed");
    PooledErrors<Real> result{{standard_errors.begin(), standard_errors.end()},
                              std::vector<int>(values.size(), degrees_of_freedom)};
    const std::size_t height = values.size() / width;
    const std::vector<double> variances = relative_variances(values, standard_errors);
    parallel_for(height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t own = y * width + x;
            if (!(values[own] > 0) || standard_errors[own] == 0) continue;
            double count = 0, sum = 0, squares = 0;
            for (std::size_t v = y - std::min(y, kReach); v <= std::min(height - 1, y + kReach); ++v) {
                for (std::size_t u = x - std::min(x, kReach); u <= std::min(width - 1, x + kReach); ++u) {
                    const std::size_t other = v * width + u;
                    const double variance = variances[other];
                    count += values[other] > 0 ? 1 : 0;
                    sum += variance, squares += variance * variance;
                }
            }
            const auto [variance, degrees] =
                pooled(variances[own], sum / count, squares * count / (sum * sum), degrees_of_freedom);
            result.standard_errors[own] = static_cast<Real>(std::sqrt(variance) * double{values[own]});
            result.degrees_of_freedom[own] = static_cast<int>(degrees);
        }
    });
    return result;
}

template PooledErrors<float> pool_errors(std::size_t, std::span<const float>, std::span<const float>, int);
template PooledErrors<double> pool_errors(std::size_t, std::span<const double>, std::span<const double>, int);

}  // namespace stilb::statistics
