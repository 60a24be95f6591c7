// Real orthonormal spherical harmonics, and functions on the sphere as series of them.
//
//     Y_lm = sqrt(2) N_lm P_lm(cos theta) cos(m phi)      m > 0
//     Y_l0 =         N_l0 P_l0(cos theta)
//     Y_lm = sqrt(2) N_l|m| P_l|m|(cos theta) sin(|m| phi)  m < 0
//
// without the Condon-Shortley sign, theta from +z, phi from +x; the integral of Y_lm^2 over the sphere is 1.
// Number l^2 + l + m. As P_lm = sin^m(theta) times a polynomial in cos(theta), and sin^m(theta) (cos, sin)(m
// phi) are polynomials in x and y, all is polynomial in x, y and z of the unit direction: no pole is special.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace stilb::math {

inline constexpr int kMostHarmonicDegree = 128;

constexpr std::size_t harmonic_count(int degree) {
    return static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 1);
}
constexpr std::size_t harmonic_number(int l, int m) {
    const int number = l * l + l + m;
    return static_cast<std::size_t>(number);
}

/// Writes the harmonic_count(degree) values [1/sqrt(sr)] at a unit direction; degree from 0 to
/// kMostHarmonicDegree.
void evaluate_harmonics(const Vec3& direction, int degree, std::span<double> values);

/// f = sum of a_lm Y_lm. T: float or double, for the coefficients and the arithmetic.
template <typename T>
class HarmonicSeries {
  public:
    /// By harmonic_number(). Throws std::invalid_argument where their number is no harmonic_count() of a
    /// degree up to kMostHarmonicDegree.
    explicit HarmonicSeries(std::span<const double> coefficients);

    int degree() const { return degree_; }
    /// The terms of degrees `low` to `high`, 0 <= low <= high <= degree(), as a series of degree `high`.
    HarmonicSeries part(int low, int high) const;

    struct Value {
        T value = 0;
        /// The gradient tangential to the sphere: the change of the value per radian.
        Vec3 gradient;
    };
    /// The values at unit directions.
    T at(const Vec3& direction) const;
    Value with_gradient(const Vec3& direction) const;
    /// The values on the parallel z = cos(theta), at phi = 2 pi k / count, k = 0, 1 ... count - 1.
    std::vector<T> on_parallel(double z, std::size_t count) const;

  private:
    HarmonicSeries() = default;

    /// Coefficients of cos(m phi) and sin(m phi).
    struct Pair {
        T cosine = 0, sine = 0;
    };
    /// Calls `visit(m, sum)`: sums over l without sin^m(theta).
    template <typename Visit>
    void for_each_order(T z, const Visit& visit) const;

    int degree_ = 0;
    std::vector<Pair> pairs_;  ///< m by m, each for l = m, m + 1 ... degree
};

extern template class HarmonicSeries<float>;
extern template class HarmonicSeries<double>;

/// Guaranteed bounds of a series over the sphere, off by 4 % of the largest magnitude at most.
struct HarmonicRange {
    double least = 0, greatest = 0;
};
HarmonicRange range_of(const HarmonicSeries<double>& series);

}  // namespace stilb::math
