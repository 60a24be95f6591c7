#include "math/zernike.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/jacobi.hpp>
#include <cmath>
#include <numbers>

#include "support/quadrature.h"

namespace stilb::math {
namespace {

Vec3 direction_above(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius * radius)};
}

TEST(Zernike, IsOrthonormalOverTheProjectedHemisphere) {
    const ZernikeBasis basis(6);
    ASSERT_EQ(basis.count(), 28u);
    for (std::size_t i = 0; i < basis.count(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            std::vector<double> values(basis.count());
            const double product = integrate(0, 1, 24, [&](double r) {
                return r * integrate(0, 2 * std::numbers::pi, 32, [&](double angle) {
                           basis.evaluate(direction_above(r, angle), values);
                           return values[i] * values[j];
                       });
            });
            EXPECT_NEAR(product, i == j ? 1 : 0, 1e-9) << i << ' ' << j;
        }
    }
}

/// Boost's Jacobi polynomials give every value.
TEST(Zernike, IsWhatBoostComputes) {
    const ZernikeBasis basis(9);
    std::vector<double> values(basis.count());
    for (const double r : {0.0, 0.1, 0.55, 0.93, 1.0}) {
        for (const double angle : {0.0, 0.7, 2.9, 4.4}) {
            basis.evaluate(direction_above(r, angle), values);
            std::size_t number = 0;
            for (int n = 0; n <= basis.degree(); ++n) {
                for (int m = -n; m <= n; m += 2) {
                    const int order = std::abs(m);
                    const double radial =
                        std::pow(r, order) * boost::math::jacobi(static_cast<unsigned>((n - order) / 2), 0.0,
                                                                 static_cast<double>(order), 2 * r * r - 1);
                    const double around = m < 0 ? std::sin(order * angle) : std::cos(order * angle);
                    const double norm = std::sqrt((m == 0 ? n + 1 : 2 * n + 2) / std::numbers::pi);
                    EXPECT_NEAR(values[number++], norm * radial * around, 1e-12) << n << ' ' << m;
                }
            }
        }
    }
}

}  // namespace
}  // namespace stilb::math
