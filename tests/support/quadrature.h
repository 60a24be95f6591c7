// Numerical integrals for tests, independent of any sampling.
#pragma once

#include <array>
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

}  // namespace stilb
