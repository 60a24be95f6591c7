#include "math/gauss_legendre.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace stilb::math {
namespace {

/// Legendre's polynomial of degree n, and its derivative, within (-1, 1).
struct Legendre {
    double value = 1, slope = 0;

    Legendre(int n, double x) {
        double before = 0;
        for (int k = 0; k < n; ++k) {
            const double next = ((2 * k + 1) * x * value - k * before) / (k + 1);
            before = value, value = next;
        }
        slope = n * (before - x * value) / (1 - x * x);
    }
};

/// Newton's iteration from Tricomi's approximation, which is so accurate that it ends after a few steps.
double zero_of(int n, int index) {
    double x = std::cos(std::numbers::pi * (index + 0.75) / (n + 0.5));
    for (int step = 0; step < 10; ++step) {
        const Legendre at(n, x);
        const double change = at.value / at.slope;
        x -= change;
        if (std::abs(change) < 1e-15) break;
    }
    return x;
}

}  // namespace

GaussLegendre gauss_legendre(int n) {
    const auto count = static_cast<std::size_t>(n);
    GaussLegendre rule{std::vector<double>(count), std::vector<double>(count)};
    for (int i = 0; i <= n / 2 && i < n; ++i) {
        const auto low = static_cast<std::size_t>(i), high = count - 1 - low;
        const double x = low == high ? 0 : zero_of(n, i);
        const double slope = Legendre(n, x).slope;
        rule.nodes[low] = -x, rule.nodes[high] = x;
        rule.weights[low] = rule.weights[high] = 2 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

}  // namespace stilb::math
