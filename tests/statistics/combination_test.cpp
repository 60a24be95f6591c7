#include "statistics/combination.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "statistics/grid_summary.h"

namespace stilb::statistics {
namespace {

constexpr int kCombinations = 2000;

Quantity quantity_from(std::vector<double> replicates) {
    const Estimate estimate = estimate_from_replicates(replicates);
    for (double& value : replicates) value -= estimate.value;
    return {estimate, std::move(replicates)};
}

TEST(Combination, OneQuantityKeepsItsEstimate) {
    Quantity quantity = quantity_from({3, 4, 8, 5});
    quantity.estimate.upper += 2;  // as for rare light
    quantity.estimate.lower -= 1;
    const Combination same = combine(quantity.estimate.value, std::vector{1.0}, std::vector{quantity}, 0.95);
    EXPECT_NEAR(same.estimate.standard_error, quantity.estimate.standard_error, 1e-12);
    EXPECT_NEAR(same.estimate.lower, quantity.estimate.lower, 1e-12);
    EXPECT_NEAR(same.estimate.upper, quantity.estimate.upper, 1e-12);
    EXPECT_EQ(same.of_replicates, (std::vector<double>{3, 4, 8, 5}));
    // A negative slope exchanges the ends.
    const Combination turned =
        combine(-quantity.estimate.value, std::vector{-1.0}, std::vector{quantity}, 0.95);
    EXPECT_NEAR(turned.estimate.lower, -quantity.estimate.upper, 1e-12);
    EXPECT_NEAR(turned.estimate.upper, -quantity.estimate.lower, 1e-12);
}

TEST(Combination, CommonErrorsCancel) {
    const Quantity quantity = quantity_from({3, 4, 8, 5});
    const Combination difference = combine(0, std::vector{1.0, -1.0}, std::vector{quantity, quantity}, 0.95);
    EXPECT_EQ(difference.estimate, Estimate{});
}

/// Replicates of two quantities of mean 10 and 20 whose errors have this correlation.
struct PairModel {
    double error = 1, correlation = 0;
    std::size_t replicates = 32;
};

/// The share of intervals of a / b that hold, and the mean of their half-widths over 1.96 true errors.
std::pair<double, double> coverage_of_ratios(const PairModel& model) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    int held = 0;
    double width = 0;
    const double own = std::sqrt(1 - model.correlation * model.correlation);
    const double count = static_cast<double>(model.replicates);
    // The variance of da / b - a db / b^2 with a = 10, b = 20.
    const double error =
        model.error * std::sqrt((0.0025 + 0.000625 - 2 * 0.00125 * model.correlation) / count);
    for (int run = 0; run < kCombinations; ++run) {
        std::vector<double> a, b;
        for (std::size_t r = 0; r < model.replicates; ++r) {
            const double first = normal(random), second = normal(random);
            a.push_back(10 + model.error * first);
            b.push_back(20 + model.error * (model.correlation * first + own * second));
        }
        const std::vector<Quantity> quantities{quantity_from(a), quantity_from(b)};
        const double x = quantities[0].estimate.value, y = quantities[1].estimate.value;
        const Estimate ratio = combine(x / y, std::vector{1 / y, -x / (y * y)}, quantities, 0.95).estimate;
        held += ratio.lower <= 0.5 && 0.5 <= ratio.upper;
        width += (ratio.upper - ratio.lower) / 2 / kCombinations;
    }
    return {held / static_cast<double>(kCombinations), width / (1.96 * error)};
}

TEST(Combination, IntervalsOfRatiosHold) {
    for (const PairModel& model : {PairModel{1, 0}, PairModel{1, 0.95}, PairModel{1, -0.9}, PairModel{2, 0.5},
                                   PairModel{0.2, 0.99, 8}}) {
        const auto [share, width] = coverage_of_ratios(model);
        EXPECT_NEAR(share, 0.95, 0.015) << model.error << ' ' << model.correlation;
        // Student's quantile over 1.96, times the bias of s.
        EXPECT_NEAR(width, model.replicates == 32 ? 1.03 : 1.17, 0.03)
            << model.error << ' ' << model.correlation;
    }
}

/// The minimum of one grid over the mean of another, as a designer compares a task with its surroundings.
/// Where many readings may be the minimum, the interval is conservative as the minimum's own is.
TEST(Combination, IntervalsOfMinimaOverMeansHold) {
    for (const bool is_clear : {true, false}) {
        std::mt19937_64 random(11);
        std::normal_distribution<double> normal;
        std::vector<double> truth(64, 100.0);
        if (is_clear) truth[20] = 50;
        const double exact = is_clear ? 0.25 : 0.5;
        int held = 0;
        for (int run = 0; run < 1000; ++run) {
            std::vector<double> grid, other;
            for (std::size_t r = 0; r < 32; ++r) {
                const double common = normal(random);
                for (const double value : truth) grid.push_back(value + 3 * common + 3 * normal(random));
                other.push_back(200 + 5 * common + normal(random));
            }
            const ReplicateTable table{grid, 64};
            const std::vector<Quantity> quantities{
                {summarize_grid(table).minimum, residuals_of(table, Statistic::minimum)},
                quantity_from(other)};
            const double x = quantities[0].estimate.value, y = quantities[1].estimate.value;
            const Estimate ratio =
                combine(x / y, std::vector{1 / y, -x / (y * y)}, quantities, 0.95).estimate;
            held += ratio.lower <= exact && exact <= ratio.upper;
        }
        EXPECT_GE(held, 935) << is_clear;
        if (is_clear) {
            EXPECT_LE(held, 975);
        }
    }
}

}  // namespace
}  // namespace stilb::statistics
