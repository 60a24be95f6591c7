// Polynomials of two variables over the square from -1 to 1, of degree N - 1 in each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace stilb::geometry {

template <std::size_t N>
using Matrix = std::array<std::array<double, N>, N>;

/// Chebyshev's points including the ends.
template <std::size_t N>
std::array<double, N> lobatto_nodes() {
    std::array<double, N> nodes{};
    for (std::size_t k = 0; k < N; ++k) {
        nodes[k] = -std::cos(std::numbers::pi * static_cast<double>(k) / static_cast<double>(N - 1));
    }
    return nodes;
}

/// The matrix from values at nodes to coefficients of powers: row p, column node, from Lagrange's
/// polynomials.
template <std::size_t N>
Matrix<N> power_matrix(const std::array<double, N>& nodes) {
    Matrix<N> matrix{};
    for (std::size_t node = 0; node < N; ++node) {
        std::array<double, N> powers{1};
        for (std::size_t other = 0; other < N; ++other) {
            if (other == node) continue;
            const double scale = 1 / (nodes[node] - nodes[other]);
            for (std::size_t p = N; p-- > 0;) {
                powers[p] = scale * ((p > 0 ? powers[p - 1] : 0) - nodes[other] * powers[p]);
            }
        }
        for (std::size_t p = 0; p < N; ++p) matrix[p][node] = powers[p];
    }
    return matrix;
}

/// The matrix from coefficients of powers to Bernstein's over [-1, 1], which enclose the polynomial: row i,
/// column p. Column p has the coefficients of x^p in (1 + x)^i (1 - x)^(N - 1 - i) over binomial(N - 1, p).
template <std::size_t N>
Matrix<N> bernstein_matrix() {
    const auto product = [](std::size_t plus, std::size_t minus) {
        std::array<double, N> c{1};
        for (std::size_t factor = 0; factor < plus + minus; ++factor) {
            for (std::size_t p = N; p-- > 1;) c[p] += factor < plus ? c[p - 1] : -c[p - 1];
        }
        return c;
    };
    const auto binomials = product(N - 1, 0);
    Matrix<N> matrix{};
    for (std::size_t i = 0; i < N; ++i) {
        const auto row = product(i, N - 1 - i);
        for (std::size_t p = 0; p < N; ++p) matrix[i][p] = row[p] / binomials[p];
    }
    return matrix;
}

/// M c M^T.
template <std::size_t N>
Matrix<N> transformed(const Matrix<N>& m, const Matrix<N>& c) {
    Matrix<N> half{}, whole{};
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t p = 0; p < N; ++p) {
            for (std::size_t q = 0; q < N; ++q) half[i][q] += m[i][p] * c[p][q];
        }
    }
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j < N; ++j) {
            for (std::size_t q = 0; q < N; ++q) whole[i][j] += half[i][q] * m[j][q];
        }
    }
    return whole;
}

/// The nodal values of a function of a and b.
struct ValueAndSlopes {
    double value = 0, along_a = 0, along_b = 0;
};

/// sum of c[p][q] a^p b^q.
template <std::size_t N>
ValueAndSlopes evaluate(const Matrix<N>& c, double a, double b) {
    std::array<double, N> rows{}, slopes{};  // sums over p, and their derivatives
    for (std::size_t p = N; p-- > 0;) {
        for (std::size_t q = 0; q < N; ++q) {
            slopes[q] = slopes[q] * a + rows[q];
            rows[q] = rows[q] * a + c[p][q];
        }
    }
    ValueAndSlopes sum;
    for (std::size_t q = N; q-- > 0;) {
        sum.along_b = sum.along_b * b + sum.value;
        sum.value = sum.value * b + rows[q];
        sum.along_a = sum.along_a * b + slopes[q];
    }
    return sum;
}

/// c[0] + c[1] a + c[2] b + c[3] a^2 + c[4] a b + c[5] b^2.
using Quadratic = std::array<float, 6>;

/// The truncation of Chebyshev's series at total degree 2: nearly the best approximation.
template <std::size_t N>
Quadratic quadratic_part(const Matrix<N>& c) {
    // Coefficients of T_0, T_1 and T_2 in x^p: binomials over 2^p, twice those for T_1 and T_2.
    Matrix<3> low{};
    std::array<std::array<double, N>, 3> share{};
    for (std::size_t p = 0; p < N; ++p) {
        for (std::size_t n = p % 2; n <= std::min<std::size_t>(p, 2); n += 2) {
            double binomial = 1;  // p over (p - n) / 2
            for (std::size_t k = 0; k < (p - n) / 2; ++k) {
                binomial *= static_cast<double>(p - k) / static_cast<double>(k + 1);
            }
            share[n][p] = (n == 0 ? 1 : 2) * std::ldexp(binomial, -static_cast<int>(p));
        }
    }
    for (std::size_t m = 0; m < 3; ++m) {
        for (std::size_t n = 0; m + n < 3; ++n) {
            for (std::size_t p = 0; p < N; ++p) {
                for (std::size_t q = 0; q < N; ++q) low[m][n] += share[m][p] * share[n][q] * c[p][q];
            }
        }
    }
    const auto to_float = [](double x) { return static_cast<float>(x); };
    return {to_float(low[0][0] - low[2][0] - low[0][2]),
            to_float(low[1][0]),
            to_float(low[0][1]),
            to_float(2 * low[2][0]),
            to_float(low[1][1]),
            to_float(2 * low[0][2])};
}

}  // namespace stilb::geometry
