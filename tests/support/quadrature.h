// Numerical integrals for tests, independent of any sampling.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace stilb {

/// Composite Gauss-Legendre rule of four points on `parts` equal parts of [low, high]; of numbers or spectra.
template <typename Function>
auto integrate(double low, double high, int parts, Function&& f) {
    constexpr std::array<double, 4> nodes{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                          0.8611363115940526};
    constexpr std::array<double, 4> weights{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                            0.3478548451374538};
    const double half = (high - low) / (2 * parts);
    std::decay_t<decltype(f(low))> sum{};
    for (int part = 0; part < parts; ++part) {
        const double middle = low + (2 * part + 1) * half;
        for (std::size_t i = 0; i < nodes.size(); ++i) sum += weights[i] * f(middle + nodes[i] * half);
    }
    return sum * half;
}

/// The same of a number, with parts halved until halving changes the integral over each by less than its
/// share of `tolerance`. Features much narrower than 1/16 of [low, high] might be missed.
template <typename Function>
double integrate_adaptively(double low, double high, double tolerance, const Function& f) {
    const auto refine = [&](const auto& self, double a, double b, double whole, double allowed) -> double {
        const double middle = (a + b) / 2;
        const double left = integrate(a, middle, 1, f), right = integrate(middle, b, 1, f);
        if (!(std::abs(left + right - whole) > allowed) || middle == a || middle == b) return left + right;
        return self(self, a, middle, left, allowed / 2) + self(self, middle, b, right, allowed / 2);
    };
    constexpr int parts = 8;
    const double step = (high - low) / parts;
    double sum = 0;
    for (int part = 0; part < parts; ++part) {
        const double a = low + part * step, b = a + step;
        sum += refine(refine, a, b, integrate(a, b, 1, f), tolerance / parts);
    }
    return sum;
}

}  // namespace stilb
