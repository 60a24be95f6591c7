#include "math/spherical_harmonics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/spherical_harmonic.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "math/random.h"

namespace stilb::math {
namespace {

Vec3 direction_at(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

const std::array kDirections{direction_at(0.3, 1),     direction_at(1.4, -2),      direction_at(2.9, 4),
                             direction_at(kPi, 0),     direction_at(0, 0),         direction_at(1e-7, 0.4),
                             direction_at(kPi / 2, 3), direction_at(kPi / 2, kPi), direction_at(0.02, 6)};

/// By Boost, whose harmonics have the Condon-Shortley sign.
double by_boost(int l, int m, const Vec3& d) {
    const double theta = std::acos(std::clamp(d.z, -1.0, 1.0)), phi = std::atan2(d.y, d.x);
    const auto order = static_cast<unsigned>(l);
    if (m == 0) return boost::math::spherical_harmonic_r(order, 0, theta, phi);
    const double sign = m % 2 == 0 ? std::numbers::sqrt2 : -std::numbers::sqrt2;
    return sign * (m > 0 ? boost::math::spherical_harmonic_r(order, m, theta, phi)
                         : boost::math::spherical_harmonic_i(order, -m, theta, phi));
}

TEST(SphericalHarmonics, AreWhatBoostComputes) {
    constexpr int degree = 40;
    std::vector<double> values(harmonic_count(degree));
    for (const Vec3& direction : kDirections) {
        evaluate_harmonics(direction, degree, values);
        for (int l = 0; l <= degree; ++l) {
            for (int m = -l; m <= l; ++m) {
                // acos() loses half the digits at the poles.
                EXPECT_NEAR(values[harmonic_number(l, m)], by_boost(l, m, direction), 2e-7 * (l + 1))
                    << l << ' ' << m << ' ' << direction.z;
            }
        }
    }
}

TEST(SphericalHarmonics, HaveTheirFirstSigns) {
    const Vec3 d = direction_at(0.7, 0.4);
    std::vector<double> values(harmonic_count(1));
    evaluate_harmonics(d, 1, values);
    const double one = std::sqrt(3 / (4 * kPi));
    EXPECT_DOUBLE_EQ(values[0], std::sqrt(1 / (4 * kPi)));
    EXPECT_DOUBLE_EQ(values[1], one * d.y);
    EXPECT_DOUBLE_EQ(values[2], one * d.z);
    EXPECT_DOUBLE_EQ(values[3], one * d.x);
}

/// Gauss rule over z, trapezoids over phi: exact for products of two.
TEST(SphericalHarmonics, AreOrthonormal) {
    using Gauss = boost::math::quadrature::gauss<double, 15>;
    constexpr int degree = 14, angles = 2 * degree + 2;
    std::vector<double> values(harmonic_count(degree)), products(values.size() * values.size());
    for (std::size_t node = 0; node < Gauss::abscissa().size(); ++node) {
        for (const double side : {-1., 1.}) {
            const double z = side * Gauss::abscissa()[node], r = std::sqrt(1 - z * z);
            if (z == 0 && side > 0) continue;
            for (int k = 0; k < angles; ++k) {
                const double phi = 2 * kPi * k / angles, weight = Gauss::weights()[node] * 2 * kPi / angles;
                evaluate_harmonics({r * std::cos(phi), r * std::sin(phi), z}, degree, values);
                for (std::size_t i = 0; i < values.size(); ++i) {
                    for (std::size_t j = 0; j <= i; ++j)
                        products[i * values.size() + j] += weight * values[i] * values[j];
                }
            }
        }
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            EXPECT_NEAR(products[i * values.size() + j], i == j ? 1 : 0, 1e-12) << i << ' ' << j;
        }
    }
}

/// sum over m of Y_lm(u) Y_lm(v) = (2 l + 1) / (4 pi) P_l(u v).
TEST(SphericalHarmonics, ObeyTheAdditionTheoremToDegree128) {
    constexpr int degree = kMostHarmonicDegree;
    std::vector<double> at_u(harmonic_count(degree)), at_v(at_u.size());
    for (const Vec3& u : kDirections) {
        evaluate_harmonics(u, degree, at_u);
        for (const Vec3& v : kDirections) {
            evaluate_harmonics(v, degree, at_v);
            double before = 0, legendre = 1;
            for (int l = 0; l <= degree; ++l) {
                double sum = 0;
                for (int m = -l; m <= l; ++m)
                    sum += at_u[harmonic_number(l, m)] * at_v[harmonic_number(l, m)];
                EXPECT_NEAR(sum, (2 * l + 1) / (4 * kPi) * legendre, 1e-10) << l << ' ' << u.z << ' ' << v.z;
                const double next = ((2 * l + 1) * dot(u, v) * legendre - l * before) / (l + 1);
                before = legendre, legendre = next;
            }
        }
    }
}

std::vector<double> random_coefficients(int degree) {
    std::vector<double> coefficients;
    for (std::uint64_t i = 0; i < harmonic_count(degree); ++i) {
        coefficients.push_back(unit_interval(random_block(RandomKey{7}, i, 0)[0]) - 0.5);
    }
    return coefficients;
}

TEST(HarmonicSeries, SumsItsHarmonics) {
    for (const int degree : {0, 1, 5, 64, 128}) {
        const std::vector<double> coefficients = random_coefficients(degree);
        const HarmonicSeries<double> series(coefficients);
        const HarmonicSeries<float> single(coefficients);
        std::vector<double> values(coefficients.size());
        for (const Vec3& direction : kDirections) {
            evaluate_harmonics(direction, degree, values);
            double sum = 0, size = 0;
            for (std::size_t i = 0; i < values.size(); ++i) {
                sum += coefficients[i] * values[i];
                size += values[i] * values[i];
            }
            size = std::sqrt(size);
            EXPECT_NEAR(series.at(direction), sum, 1e-13 * size);
            EXPECT_EQ(series.with_gradient(direction).value, series.at(direction));
            EXPECT_NEAR(double{single.at(direction)}, sum, 1e-6 * (degree + 1) * size) << degree;
            EXPECT_EQ(single.with_gradient(direction).value, single.at(direction));
        }
    }
}

TEST(HarmonicSeries, IsTheSameOnParallels) {
    const HarmonicSeries<double> series(random_coefficients(20));
    for (const double z : {-1.0, -0.6, 0.0, 0.99, 1.0}) {
        for (const std::size_t count : {1u, 7u, 60u}) {
            const std::vector<double> values = series.on_parallel(z, count);
            ASSERT_EQ(values.size(), count);
            for (std::size_t k = 0; k < count; ++k) {
                const double phi = 2 * kPi * static_cast<double>(k) / static_cast<double>(count);
                EXPECT_NEAR(values[k], series.at(direction_at(std::acos(z), phi)), 1e-11) << z << ' ' << k;
            }
        }
    }
}

/// Differences along great circles, on both sides: wrong by their square.
TEST(HarmonicSeries, HasTheGradientOfItsValues) {
    for (const int degree : {1, 8, 32, 128}) {
        const HarmonicSeries<double> series(random_coefficients(degree));
        const HarmonicSeries<float> single(random_coefficients(degree));
        const double step = 1e-4 / degree;
        for (const Vec3& direction : kDirections) {
            const Frame frame = Frame::around(direction);
            const Vec3 gradient = series.with_gradient(direction).gradient;
            EXPECT_NEAR(dot(gradient, direction), 0, 1e-9 * degree * degree);
            for (const Vec3& along : {frame.u, frame.v}) {
                const auto at = [&](double angle) {
                    return series.at(std::cos(angle) * direction + std::sin(angle) * along);
                };
                const double slope = (at(step) - at(-step)) / (2 * step);
                EXPECT_NEAR(dot(gradient, along), slope, 1e-6 * degree * degree)
                    << degree << ' ' << direction.z;
                EXPECT_NEAR(dot(single.with_gradient(direction).gradient, along), slope,
                            1e-4 * degree * degree);
            }
        }
    }
}

TEST(HarmonicSeries, RefusesOtherNumbersOfCoefficients) {
    EXPECT_THROW(HarmonicSeries<double>(std::vector<double>(5)), std::invalid_argument);
    EXPECT_THROW(HarmonicSeries<double>(std::vector<double>{}), std::invalid_argument);
    EXPECT_THROW(HarmonicSeries<double>(std::vector<double>(harmonic_count(129))), std::invalid_argument);
}

}  // namespace
}  // namespace stilb::math
