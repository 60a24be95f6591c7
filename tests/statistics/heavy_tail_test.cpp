#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "statistics/interval.h"

namespace stilb::statistics {
namespace {

TEST(HeavyTail, ComparesTheLargestContributionWithItsAllowedShare) {
    EXPECT_DOUBLE_EQ(heavy_tail_share(10'000), 0.01);
    EXPECT_FALSE(is_heavy_tailed(0.99, 100, 10'000));
    EXPECT_TRUE(is_heavy_tailed(1.01, 100, 10'000));
    EXPECT_FALSE(is_heavy_tailed(0, 0, 10'000));
    EXPECT_FALSE(is_heavy_tailed(1, 1, 1));
}

/// Share of 400 sums of 10,000 contributions that are warned of; P(contribution > x) = x^-tail_index.
double warned_share(double tail_index) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform;
    constexpr int kRuns = 400, kCount = 10'000;
    int warned = 0;
    for (int run = 0; run < kRuns; ++run) {
        double largest = 0, sum = 0;
        for (int i = 0; i < kCount; ++i) {
            const double contribution = std::pow(1 - uniform(random), -1 / tail_index);
            largest = std::max(largest, contribution);
            sum += contribution;
        }
        warned += is_heavy_tailed(largest, sum, kCount) ? 1 : 0;
    }
    return warned / double{kRuns};
}

TEST(HeavyTail, TellsInfiniteVarianceFromFinite) {
    EXPECT_GT(warned_share(1.2), 0.99);
    EXPECT_GT(warned_share(1.5), 0.8);
    EXPECT_LT(warned_share(3), 0.02);
}

}  // namespace
}  // namespace stilb::statistics
