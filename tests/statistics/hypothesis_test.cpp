#include "statistics/hypothesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace stilb::statistics {
namespace {

TEST(ZScore, IsTheDifferenceInStandardErrors) {
    const Estimate a{.value = 10, .standard_error = 3}, b{.value = 20, .standard_error = 4};
    EXPECT_DOUBLE_EQ(z_score(a, b), -2);
    EXPECT_DOUBLE_EQ(z_score(b, a), 2);
    EXPECT_DOUBLE_EQ(z_score(a, 4), 2);
}

TEST(ZScore, WithoutErrorToleratesNothing) {
    const Estimate exact{.value = 1, .standard_error = 0};
    EXPECT_EQ(z_score(exact, 1), 0);
    EXPECT_EQ(z_score(exact, exact), 0);
    EXPECT_EQ(z_score(exact, 1.5), -INFINITY);
}

TEST(PValue, HasTheTabulatedValues) {
    EXPECT_NEAR(two_sided_p_of_z(1.959964), 0.05, 1e-7);
    EXPECT_NEAR(two_sided_p_of_z(-4), 6.334e-5, 1e-8);
    EXPECT_NEAR(two_sided_p_of_t(2.131450, 15), 0.05, 1e-7);
    EXPECT_EQ(two_sided_p_of_t(-INFINITY, 15), 0);
    EXPECT_DOUBLE_EQ(two_sided_p_of_t(0, 15), 1);
}

TEST(EquivalentZ, HasTheSameTail) {
    for (const double t : {-6.0, -2.0, -0.1, 0.1, 2.0, 6.0, 40.0}) {
        const double z = equivalent_z(t, 15);
        EXPECT_NEAR(two_sided_p_of_z(z) / two_sided_p_of_t(t, 15), 1, 1e-9) << t;
        EXPECT_EQ(std::signbit(z), std::signbit(t));
        EXPECT_LT(std::abs(z), std::abs(t));
    }
    EXPECT_NEAR(equivalent_z(3, 1'000'000), 3, 1e-4);
    EXPECT_EQ(equivalent_z(0, 15), 0);
    EXPECT_EQ(equivalent_z(-INFINITY, 15), -INFINITY);
}

TEST(SidakThreshold, GivesTheFamilyItsErrorRate) {
    EXPECT_NEAR(sidak_threshold_z(0.05, 1), 1.959964, 1e-6);
    const double threshold = sidak_threshold_z(0.01, 1000);
    EXPECT_NEAR(1 - std::pow(1 - two_sided_p_of_z(threshold), 1000), 0.01, 1e-9);
}

TEST(Chi2, HasTheStatisticOfAWorkedExample) {
    // 60 throws of a die.
    const std::vector<double> observed{5, 8, 9, 8, 10, 20}, expected(6, 10.0);
    const Chi2Result result = chi2_test(observed, expected);
    EXPECT_DOUBLE_EQ(result.statistic, 13.4);
    EXPECT_EQ(result.degrees_of_freedom, 5);
    EXPECT_NEAR(result.p_value, 0.0199, 1e-4);
}

TEST(Chi2, MergesBinsWithSmallExpectations) {
    const std::vector<double> observed{10, 1, 4, 1, 4}, expected{10, 2, 3, 1, 4};
    const Chi2Result result = chi2_test(observed, expected);
    // 1 + 2 + 3 together, then 4 alone is too little and joins the last bin.
    EXPECT_EQ(result.degrees_of_freedom, 1);
    EXPECT_DOUBLE_EQ(result.statistic, 0);
    EXPECT_EQ(chi2_test(observed, expected, 1).degrees_of_freedom, 4);
}

TEST(Chi2, RefusesCountsWhereNothingIsExpected) {
    const std::vector<double> observed{100, 100, 1}, allowed{100, 101, 0};
    EXPECT_EQ(chi2_test(observed, allowed).p_value, 0);
    const std::vector<double> none{100, 101, 0};
    EXPECT_EQ(chi2_test(none, allowed).degrees_of_freedom, 1);
    EXPECT_DOUBLE_EQ(chi2_test(none, allowed).p_value, 1);
}

TEST(Chi2, WithOneBinLeftSaysNothing) {
    const std::vector<double> observed{1, 2}, expected{2, 1};
    EXPECT_EQ(chi2_test(observed, expected).degrees_of_freedom, 0);
    EXPECT_EQ(chi2_test(observed, expected).p_value, 1);
    const std::vector<double> shorter{1};
    EXPECT_THROW(chi2_test(observed, shorter), std::invalid_argument);
}

std::vector<double> p_values_of_fair_multinomials(std::size_t runs) {
    std::mt19937_64 random(3);
    std::uniform_int_distribution<std::size_t> bin(0, 19);
    std::vector<double> p_values;
    const std::vector<double> expected(20, 50.0);
    for (std::size_t run = 0; run < runs; ++run) {
        std::vector<double> observed(20, 0.0);
        for (int i = 0; i < 1000; ++i) observed[bin(random)] += 1;
        p_values.push_back(chi2_test(observed, expected).p_value);
    }
    return p_values;
}

TEST(Chi2, HasUniformPValuesIfTheExpectationsAreTrue) {
    EXPECT_GT(uniformity_p(p_values_of_fair_multinomials(1000)), 1e-3);
}

TEST(UniformityP, HasTheCriticalValuesOfTheTables) {
    // The critical distance for 20 numbers at 5 % is 0.294: uniform steps shifted by it beyond their own half
    // step.
    const auto p_at_distance = [](double distance) {
        std::vector<double> numbers;
        for (int i = 0; i < 20; ++i) numbers.push_back(std::min(1.0, i / 20.0 + distance));
        return uniformity_p(numbers);
    };
    EXPECT_NEAR(p_at_distance(0.294), 0.05, 0.003);
    EXPECT_NEAR(p_at_distance(0.352), 0.01, 0.001);
}

TEST(UniformityP, IsItselfUniformForUniformNumbers) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform;
    constexpr int kRuns = 4000;
    int below = 0;
    std::vector<double> numbers(50);
    for (int run = 0; run < kRuns; ++run) {
        for (double& number : numbers) number = uniform(random);
        below += uniformity_p(numbers) < 0.1 ? 1 : 0;
    }
    EXPECT_NEAR(below / double{kRuns}, 0.1, 4 * std::sqrt(0.1 * 0.9 / kRuns));
}

TEST(UniformityP, NoticesASlightBias) {
    std::vector<double> numbers;
    for (int i = 0; i < 1000; ++i) numbers.push_back(std::pow((i + 0.5) / 1000, 1.3));
    EXPECT_LT(uniformity_p(numbers), 1e-3);
}

}  // namespace
}  // namespace stilb::statistics
