#include "statistics/hypothesis.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace stilb::statistics {
namespace {

namespace bm = boost::math;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double ratio_to_error(double difference, double standard_error) {
    if (difference == 0) return 0;
    return standard_error > 0 ? difference / standard_error : std::copysign(kInfinity, difference);
}

struct Bin {
    double observed = 0, expected = 0;
};

/// Bins with at least the least expectation each, if the total allows it; bins without any expectation are
/// left out.
std::vector<Bin> merge_bins(std::vector<Bin> bins, double least_expected) {
    std::stable_sort(bins.begin(), bins.end(), [](Bin a, Bin b) { return a.expected < b.expected; });
    std::vector<Bin> merged;
    Bin open;
    for (const Bin& bin : bins) {
        open.observed += bin.observed;
        open.expected += bin.expected;
        if (open.expected >= least_expected) {
            merged.push_back(open);
            open = {};
        }
    }
    if (merged.empty()) return {open};
    merged.back().observed += open.observed;
    merged.back().expected += open.expected;
    return merged;
}

}  // namespace

double z_score(const Estimate& a, const Estimate& b) {
    return ratio_to_error(a.value - b.value, std::hypot(a.standard_error, b.standard_error));
}

double z_score(const Estimate& estimate, double exact) {
    return ratio_to_error(estimate.value - exact, estimate.standard_error);
}

double two_sided_p_of_z(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double two_sided_p_of_t(double t, int degrees_of_freedom) {
    if (std::isinf(t)) return 0;
    return 2 * bm::cdf(bm::students_t(degrees_of_freedom), -std::abs(t));
}

double equivalent_z(double t, int degrees_of_freedom) {
    const double tail = two_sided_p_of_t(t, degrees_of_freedom) / 2;
    const double size = tail > 0 ? -bm::quantile(bm::normal(), tail) : kInfinity;
    return std::copysign(size, t);
}

double sidak_threshold_z(double family_error, std::size_t comparisons) {
    const double each = -std::expm1(std::log1p(-family_error) / static_cast<double>(comparisons));
    return -bm::quantile(bm::normal(), each / 2);
}

Chi2Result chi2_test(std::span<const double> observed, std::span<const double> expected,
                     double least_expected) {
    if (observed.size() != expected.size()) {
        throw std::invalid_argument("chi2_test takes one expectation per count");
    }
    std::vector<Bin> bins;
    bool impossible = false;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        bins.push_back({observed[i], expected[i]});
        impossible = impossible || (expected[i] <= 0 && observed[i] > 0);
    }
    const std::vector<Bin> merged = merge_bins(std::move(bins), least_expected);
    Chi2Result result;
    result.degrees_of_freedom = static_cast<int>(merged.size()) - 1;
    if (impossible) return {kInfinity, result.degrees_of_freedom, 0};
    if (result.degrees_of_freedom == 0) return result;
    for (const Bin& bin : merged) {
        const double apart = bin.observed - bin.expected;
        result.statistic += apart * apart / bin.expected;
    }
    result.p_value = bm::cdf(bm::complement(bm::chi_squared(result.degrees_of_freedom), result.statistic));
    return result;
}

double uniformity_p(std::span<const double> numbers) {
    std::vector<double> sorted(numbers.begin(), numbers.end());
    std::sort(sorted.begin(), sorted.end());
    const double count = static_cast<double>(sorted.size());
    double distance = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const double below = static_cast<double>(i) / count;
        distance = std::max({distance, sorted[i] - below, below + 1 / count - sorted[i]});
    }
    const double lambda = (std::sqrt(count) + 0.12 + 0.11 / std::sqrt(count)) * distance;
    if (lambda < 0.2) return 1;  // the series below converges slowly; its value is 1 to 12 digits
    double p = 0;
    for (int k = 1; k <= 30; ++k) p += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * lambda * lambda);
    return std::clamp(p, 0.0, 1.0);
}

}  // namespace stilb::statistics
