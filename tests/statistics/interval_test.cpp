#include "statistics/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace stilb::statistics {
namespace {

// Printed tables of Student's t.
TEST(StudentT, HasTheTabulatedQuantiles) {
    EXPECT_NEAR(student_t_quantile(0.975, 1), 12.706, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.975, 15), 2.131, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.975, 31), 2.040, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.995, 30), 2.750, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.05, 10), -1.812, 5e-4);
}

TEST(Interval, IsTheMeanWithTheStudentTimesTheStandardError) {
    const std::vector<double> replicates{9, 10, 11, 14};
    const Estimate estimate = estimate_from_replicates(replicates);
    const double standard_error = std::sqrt((4 + 1 + 0 + 9) / 3.0 / 4);
    EXPECT_DOUBLE_EQ(estimate.value, 11);
    EXPECT_DOUBLE_EQ(estimate.standard_error, standard_error);
    EXPECT_NEAR(estimate.upper - 11, 3.18245 * standard_error, 1e-4);
    EXPECT_NEAR(11 - estimate.lower, 3.18245 * standard_error, 1e-4);
}

TEST(Interval, OfEqualReplicatesIsExactlyTheirValue) {
    const std::vector<double> replicates(7, 0.1);
    EXPECT_EQ(estimate_from_replicates(replicates), (Estimate{0.1, 0, 0.1, 0.1}));
}

TEST(Interval, OfAReadingDoesNotDependOnItsNeighbours) {
    const std::vector<double> table{1, 10, 2, 30, 6, 20};
    const std::vector<Estimate> readings = estimate_readings({table, 2}, 0.9);
    const std::vector<double> first{1, 2, 6}, second{10, 30, 20};
    ASSERT_EQ(readings.size(), 2U);
    EXPECT_EQ(readings[0], estimate_from_replicates(first, 0.9));
    EXPECT_EQ(readings[1], estimate_from_replicates(second, 0.9));
}

TEST(Interval, TakesAtLeastTwoWholeReplicates) {
    const std::vector<double> one{1}, ragged{1, 2, 3, 4, 5};
    EXPECT_THROW(estimate_from_replicates(one), std::invalid_argument);
    EXPECT_THROW(estimate_from_replicates({}), std::invalid_argument);
    EXPECT_THROW(estimate_readings({ragged, 2}), std::invalid_argument);
    EXPECT_THROW(estimate_readings({ragged, 0}), std::invalid_argument);
}

TEST(Interval, CoversTheTruthAsOftenAsItSays) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal(3, 2);
    for (const std::size_t replicates : {2U, 16U, 32U}) {
        constexpr int kRuns = 20000;
        int held = 0;
        std::vector<double> means(replicates);
        for (int run = 0; run < kRuns; ++run) {
            for (double& mean : means) mean = normal(random);
            const Estimate estimate = estimate_from_replicates(means, 0.9);
            held += estimate.lower <= 3 && 3 <= estimate.upper ? 1 : 0;
        }
        const double z = (held - 0.9 * kRuns) / std::sqrt(0.9 * 0.1 * kRuns);
        EXPECT_LT(std::abs(z), 3.5) << replicates << " replicates";
    }
}

TEST(RelativeHalfWidth, CountsExactDarknessAsKnown) {
    EXPECT_DOUBLE_EQ(relative_half_width({.value = 10, .lower = 8, .upper = 12}), 0.2);
    EXPECT_DOUBLE_EQ(relative_half_width({.value = -10, .lower = -12, .upper = -8}), 0.2);
    EXPECT_EQ(relative_half_width({}), 0);
    EXPECT_TRUE(std::isinf(relative_half_width({.value = 0, .lower = -1, .upper = 1})));
}

}  // namespace
}  // namespace stilb::statistics
