// Guaranteed roots of functions on intervals. `f(x)` gives value and slope as a pair; a root is a change
// of sign.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace stilb::math {

enum class Sign { negative, positive };

/// 0 counts as positive.
constexpr Sign sign_of(double value) { return value < 0 ? Sign::negative : Sign::positive; }

/// The root of a monotone function between `low` and `high`, where the signs differ; `guess` is between them,
/// too. By Newton's steps, or bisection where those leave the interval or hardly progress. The last of
/// Newton's steps is at most 1e-9 of the interval, or leaves an error of at most 1e-12 of it for a second
/// derivative of at most `curvature`.
template <typename Function>
double root_between(const Function& f, double curvature, double low, double high, Sign at_low, double guess) {
    const double enough = 1e-9 * (high - low), exact = 1e-12 * (high - low);
    double x = guess, before = high - low;
    while (true) {
        const auto [value, slope] = f(x);
        if (value == 0) return x;
        (sign_of(value) == at_low ? low : high) = x;
        const double step = -value / slope, middle = 0.5 * (low + high);
        // Newton's error is below curvature / (2 slope) times the square of the previous error; 4, because
        // the previous error may be twice the step, and the slope in between half of this one.
        const bool is_last = 4 * curvature * step * step <= exact * std::abs(slope);
        if (std::abs(step) <= enough || is_last || middle == low || middle == high) {
            return std::clamp(x + step, low, high);
        }
        const bool leads_on = low < x + step && x + step < high && std::abs(step) < 0.5 * before;
        before = leads_on ? std::abs(step) : high - low;
        x = leads_on ? x + step : middle;
    }
}

/// The root of a monotone function without bounds of its second derivative, if it has one between `low` and
/// `high`.
template <typename Function>
std::optional<double> root_of_monotone(const Function& f, double low, double high) {
    const Sign at_low = sign_of(f(low).first);
    if (at_low == sign_of(f(high).first)) return std::nullopt;
    constexpr double unknown = std::numeric_limits<double>::infinity();
    return root_between(f, unknown, low, high, at_low, 0.5 * (low + high));
}

/// The first change of sign after `low`, where the sign is known, up to `high`, of a function whose second
/// derivative is nowhere larger than `curvature`. Intervals narrower than 2 `narrowest` are judged by their
/// ends alone: a pair of roots in one, where the function touches 0, is ignored. Rounding loses no change:
/// where a sign contradicts the previous one, the change is there.
template <typename Function>
std::optional<double> first_root(const Function& f, double curvature, double narrowest, double low,
                                 double high, Sign at_low) {
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const auto [value, slope] = f(middle);
    if (std::abs(value) > (std::abs(slope) + 0.5 * curvature * half) * half) {
        return sign_of(value) == at_low ? std::nullopt : std::optional(low);
    }
    if (std::abs(slope) > curvature * half || half < narrowest) {
        if (sign_of(f(high).first) == at_low) return std::nullopt;
        return root_between(f, curvature, low, high, at_low, middle);
    }
    const auto found = first_root(f, curvature, narrowest, low, middle, at_low);
    return found ? found : first_root(f, curvature, narrowest, middle, high, at_low);
}

}  // namespace stilb::math
