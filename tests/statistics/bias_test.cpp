// Bounds of biases, with made-up comparisons whose biases and noise are known.
#include "statistics/bias.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace stilb::statistics {
namespace {

constexpr std::size_t kReplicates = 32;

/// Readings of 100 with biases and noise of single comparisons; part of the noise is common to all readings
/// of a replicate.
struct Comparisons {
    std::vector<double> biases;
    double own_noise = 0, common_noise = 0;

    BiasBounds bounds(std::mt19937_64& random) const {
        std::normal_distribution<double> normal;
        std::vector<double> differences;
        for (std::size_t r = 0; r < kReplicates; ++r) {
            const double common = common_noise * normal(random);
            for (const double bias : biases)
                differences.push_back(-bias + common + own_noise * normal(random));
        }
        return bias_bounds({differences, biases.size()}, std::vector<double>(biases.size(), 100));
    }

    double relative() const {
        double squares = 0;
        for (const double bias : biases) squares += bias * bias / 1e4;
        return std::sqrt(squares / static_cast<double>(biases.size()));
    }
};

/// How often bounds hold, over many draws of the noise.
struct Held {
    double relative = 0, reading = 0, mean = 0, at_least = 0;
};

Held share_held(const Comparisons& comparisons) {
    constexpr int draws = 1000;
    std::mt19937_64 random(7);
    double mean_bias = 0;
    for (const double bias : comparisons.biases)
        mean_bias += bias / static_cast<double>(comparisons.biases.size());
    Held held;
    for (int i = 0; i < draws; ++i) {
        const BiasBounds bounds = comparisons.bounds(random);
        held.relative += (bounds.relative >= comparisons.relative()) / double{draws};
        held.at_least += (bounds.relative_at_least <= comparisons.relative()) / double{draws};
        held.mean += (bounds.of_mean >= std::abs(mean_bias)) / double{draws};
        held.reading += (bounds.of_readings[0] >= std::abs(comparisons.biases[0])) / double{draws};
    }
    return held;
}

void expect_to_hold(const Comparisons& comparisons) {
    const Held held = share_held(comparisons);
    EXPECT_GT(held.relative, 0.93);
    EXPECT_GT(held.at_least, 0.93);
    EXPECT_GT(held.mean, 0.93);
    EXPECT_GT(held.reading, 0.93);
}

TEST(BiasBounds, HoldForASingleReading) {
    for (const double noise : {0.1, 3., 10., 100.}) {
        SCOPED_TRACE(noise);
        expect_to_hold({{2}, noise});
    }
}

TEST(BiasBounds, HoldForManyReadingsAlike) {
    for (const double noise : {0.1, 3., 10., 100.}) {
        SCOPED_TRACE(noise);
        expect_to_hold({std::vector<double>(50, 2), noise});
        expect_to_hold({std::vector<double>(50, -2), noise / 2, noise});
    }
}

/// The first reading's bias is three times the root mean square: found where its own comparison shows it.
TEST(BiasBounds, HoldForTheWorstReadingWhereItStandsOut) {
    std::vector<double> biases(50, 1);
    biases[0] = 10;
    expect_to_hold({biases, 0.5});
}

/// Without bias the bound falls with the noise, and far more with many readings than with one.
TEST(BiasBounds, FallWhereThereIsNoBias) {
    std::mt19937_64 random(3);
    const auto mean_bound = [&](std::size_t readings, double noise) {
        double sum = 0;
        for (int i = 0; i < 100; ++i)
            sum += Comparisons{std::vector<double>(readings), noise}.bounds(random).relative / 100;
        return sum;
    };
    const double standard_error = 0.1 / std::sqrt(double{kReplicates});
    EXPECT_LT(mean_bound(1, 10), 2.5 * standard_error);
    EXPECT_LT(mean_bound(400, 10), 0.6 * standard_error);
    EXPECT_NEAR(mean_bound(400, 1) / mean_bound(400, 10), 0.1, 0.03);
}

TEST(BiasBounds, DarkReadingsDoNotCount) {
    std::vector<double> differences;
    for (std::size_t r = 0; r < kReplicates; ++r) {
        differences.push_back(r % 2 == 0 ? 1 : 3);
        differences.push_back(0);
    }
    const BiasBounds bounds = bias_bounds({differences, 2}, std::vector<double>{100, 0});
    EXPECT_NEAR(bounds.relative, 0.02, 0.005);
    EXPECT_EQ(bounds.of_readings[1], 0);
}

TEST(BiasBounds, WidenIntervalsOnBothSides) {
    EXPECT_EQ(widened({10, 1, 8, 13}, 0.5), (Estimate{10, 1, 7.5, 13.5}));
}

}  // namespace
}  // namespace stilb::statistics
