// Roots of functions on intervals, for certain. `f(x)` gives value and slope as a pair; a root is where the
// sign changes.
#pragma once

#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <optional>

namespace stilb {

/// The root of a monotone function, if it has one between `low` and `high`.
template <typename Function>
std::optional<double> root_of_monotone(const Function& f, double low, double high) {
    if ((f(low).first < 0) == (f(high).first < 0)) return std::nullopt;
    constexpr int digits = std::numeric_limits<double>::digits - 4;
    return boost::math::tools::newton_raphson_iterate(f, 0.5 * (low + high), low, high, digits);
}

/// The first root of a function whose second derivative is nowhere larger than `curvature`. Intervals
/// narrower than 2 `narrowest` count by their ends alone: a pair of roots in one, where the function touches
/// 0, is left out.
template <typename Function>
std::optional<double> first_root(const Function& f, double curvature, double narrowest, double low,
                                 double high) {
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const auto [value, slope] = f(middle);
    if (std::abs(value) > (std::abs(slope) + 0.5 * curvature * half) * half) return std::nullopt;
    if (std::abs(slope) > curvature * half || half < narrowest) return root_of_monotone(f, low, high);
    if (const auto found = first_root(f, curvature, narrowest, low, middle)) return found;
    return first_root(f, curvature, narrowest, middle, high);
}

}  // namespace stilb
