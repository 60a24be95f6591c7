#include "statistics/pooled_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "statistics/interval.h"

namespace stilb::statistics {
namespace {

constexpr std::size_t kWidth = 64, kPixels = kWidth * kWidth;
constexpr int kPooledReplicates = 4;

/// A picture of normal errors around 1 with the deviation `sigma(x, y)`, and its own errors.
template <typename Sigma>
struct NoisyPicture {
    NoisyPicture(unsigned seed, const Sigma& sigma) : values(kPixels), errors(kPixels) {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal;
        for (std::size_t i = 0; i < kPixels; ++i) {
            std::vector<double> replicates;
            for (int r = 0; r < kPooledReplicates; ++r)
                replicates.push_back(1 + sigma(i % kWidth, i / kWidth) * std::sqrt(kPooledReplicates) *
                                             normal(random));
            const Estimate estimate = estimate_from_replicates(replicates);
            values[i] = static_cast<float>(estimate.value);
            errors[i] = static_cast<float>(estimate.standard_error);
        }
    }
    std::vector<float> values, errors;
};

/// The share of those pixels whose 95 % interval holds 1.
template <typename Sigma, typename Counted>
double coverage(const Sigma& sigma, const Counted& counted) {
    double held = 0, all = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const NoisyPicture picture(seed, sigma);
        const PooledErrors<float> pooled =
            pool_errors<float>(kWidth, picture.values, picture.errors, kPooledReplicates - 1);
        for (std::size_t i = 0; i < kPixels; ++i) {
            if (!counted(i % kWidth)) continue;
            const double t = student_t_quantile(0.975, pooled.degrees_of_freedom[i]);
            held += std::abs(double{picture.values[i]} - 1) <= t * double{pooled.standard_errors[i]} ? 1 : 0;
            ++all;
        }
    }
    return held / all;
}

TEST(PooledErrors, CoverWhereTheNoiseIsEven) {
    const auto even = [](std::size_t, std::size_t) { return 0.01; };
    EXPECT_NEAR(coverage(even, [](std::size_t) { return true; }), 0.95, 0.01);
}

/// Twice as much noise from column to column of 16 pixels.
TEST(PooledErrors, CoverWhereTheNoiseVaries) {
    const auto steps = [](std::size_t x, std::size_t) { return 0.01 * std::exp2(x / 16); };
    EXPECT_NEAR(coverage(steps, [](std::size_t) { return true; }), 0.95, 0.015);
}

/// One column has four times the noise of the others, as an edge has.
TEST(PooledErrors, CoverAnEdgeNearly) {
    const auto edge = [](std::size_t x, std::size_t) { return x == 30 ? 0.04 : 0.01; };
    EXPECT_GT(coverage(edge, [](std::size_t x) { return x == 30; }), 0.9);
    EXPECT_GT(coverage(edge, [](std::size_t x) { return x != 30; }), 0.94);
}

TEST(PooledErrors, HaveMoreDegreesOfFreedomThanAPixel) {
    const auto even = [](std::size_t, std::size_t) { return 0.01; };
    const NoisyPicture picture(1, even);
    const PooledErrors<float> pooled =
        pool_errors<float>(kWidth, picture.values, picture.errors, kPooledReplicates - 1);
    double degrees = 0, squared = 0;
    for (std::size_t i = 0; i < kPixels; ++i) {
        degrees += pooled.degrees_of_freedom[i] / static_cast<double>(kPixels);
        const double relative = double{pooled.standard_errors[i]} / 0.01 - 1;
        squared += relative * relative / static_cast<double>(kPixels);
    }
    EXPECT_GT(degrees, 12);
    EXPECT_LT(std::sqrt(squared), 0.2);  // of a pixel's own: 0.4
}

TEST(PooledErrors, LeavePixelsThatAreExactAsTheyAre) {
    const std::vector<float> values{0, 1, 1, 5, 1, 1}, errors{0, 0.1f, 0.1f, 0, 0.1f, 0.1f};
    const PooledErrors<float> pooled = pool_errors<float>(3, values, errors, 3);
    EXPECT_EQ(pooled.standard_errors[0], 0);
    EXPECT_EQ(pooled.standard_errors[3], 0);
    EXPECT_EQ(pooled.degrees_of_freedom[0], 3);
    EXPECT_GT(pooled.standard_errors[1], 0);
}

TEST(PooledErrors, NeedAllPixels) {
    const std::vector<float> three(3), four(4);
    EXPECT_THROW(pool_errors<float>(2, three, three, 3), std::invalid_argument);
    EXPECT_THROW(pool_errors<float>(2, four, three, 3), std::invalid_argument);
    EXPECT_THROW(pool_errors<float>(0, four, four, 3), std::invalid_argument);
}

}  // namespace
}  // namespace stilb::statistics
