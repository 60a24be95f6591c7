#include "math/gauss_legendre.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numeric>

namespace stilb::math {
namespace {

/// The integral of x^power over [-1, 1] by the rule.
double integral_of_power(const GaussLegendre& rule, int power) {
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        sum += rule.weights[i] * std::pow(rule.nodes[i], power);
    return sum;
}

TEST(GaussLegendre, IntegratesPolynomialsExactly) {
    for (const int n : {1, 2, 3, 10, 129, 257, 516, 1000}) {
        const GaussLegendre rule = gauss_legendre(n);
        for (const int power : {0, n, 2 * n - 2, 2 * n - 1}) {
            const double exact = power % 2 == 0 ? 2. / (power + 1) : 0;
            EXPECT_NEAR(integral_of_power(rule, power), exact, 1e-13 * n) << n << ' ' << power;
            EXPECT_NEAR(integral_of_power(rule, power), exact, 1e-9 * exact + 1e-14) << n << ' ' << power;
        }
    }
}

TEST(GaussLegendre, IsNotExactBeyond) {
    const GaussLegendre rule = gauss_legendre(5);
    EXPECT_GT(std::abs(integral_of_power(rule, 10) - 2. / 11), 1e-3);
}

TEST(GaussLegendre, IsTheRuleThatBoostHas) {
    using Boost = boost::math::quadrature::gauss<double, 20>;
    const GaussLegendre rule = gauss_legendre(20);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_NEAR(rule.nodes[10 + i], Boost::abscissa()[i], 2e-16);
        EXPECT_NEAR(rule.nodes[9 - i], -Boost::abscissa()[i], 2e-16);
        EXPECT_NEAR(rule.weights[10 + i], Boost::weights()[i], 1e-15);
    }
}

}  // namespace
}  // namespace stilb::math
