#include "statistics/grid_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace stilb::statistics {
namespace {

constexpr int kGridRuns = 2000;
constexpr double kLeastCoverage = 0.94;  // of 0.95 promised: two standard errors of 2000 runs

/// Grids of normal errors: part of every replicate's error is common to all readings, as from common light
/// light paths.
struct GridModel {
    std::string name;
    std::vector<double> truth;
    std::size_t replicates = 32;
    double error = 1;         ///< of one replicate's reading
    double common_share = 0;  ///< correlation of two readings' errors

    double mean() const {
        return std::accumulate(truth.begin(), truth.end(), 0.0) / static_cast<double>(truth.size());
    }
    double minimum() const { return *std::min_element(truth.begin(), truth.end()); }
    double maximum() const { return *std::max_element(truth.begin(), truth.end()); }
};

void PrintTo(const GridModel& model, std::ostream* out) { *out << model.name; }

class GridSimulator {
  public:
    explicit GridSimulator(const GridModel& model)
        : model_(model), means_(model.replicates * model.truth.size()) {}

    GridSummary run() { return summarize_grid({replicates(), model_.truth.size()}); }

    /// Replicates x readings of another run.
    const std::vector<double>& replicates() {
        const std::size_t points = model_.truth.size();
        const double common_error = model_.error * std::sqrt(model_.common_share);
        const double own_error = model_.error * std::sqrt(1 - model_.common_share);
        for (std::size_t r = 0; r < model_.replicates; ++r) {
            const double common = common_error * normal_(random_);
            for (std::size_t j = 0; j < points; ++j) {
                means_[r * points + j] = model_.truth[j] + common + own_error * normal_(random_);
            }
        }
        return means_;
    }

  private:
    const GridModel& model_;
    std::mt19937_64 random_{20240611};
    std::normal_distribution<double> normal_;
    std::vector<double> means_;
};

struct Coverage {
    int held = 0;
    double half_width = 0;

    void add(const Estimate& estimate, double truth) {
        held += estimate.lower <= truth && truth <= estimate.upper ? 1 : 0;
        half_width += (estimate.upper - estimate.lower) / 2 / kGridRuns;
        EXPECT_LE(estimate.lower, estimate.value);
        EXPECT_GE(estimate.upper, estimate.value);
    }
    double share() const { return held / static_cast<double>(kGridRuns); }
};

std::vector<double> equal_values(std::size_t points) { return std::vector<double>(points, 100.0); }

/// One reading lies far below and one far above the others.
std::vector<double> clear_extremes(std::size_t points) {
    std::vector<double> truth = equal_values(points);
    truth[points / 3] = 50;
    truth[points / 2] = 150;
    return truth;
}

/// A smooth bowl: many readings near the minimum, at distances comparable to the error.
std::vector<double> bowl(std::size_t points) {
    std::vector<double> truth(points);
    for (std::size_t j = 0; j < points; ++j) {
        const double from_centre = (static_cast<double>(j) + 0.5) / static_cast<double>(points) - 0.5;
        truth[j] = 100 + 10 * from_centre * from_centre;
    }
    return truth;
}

class SimulatedGrid : public testing::TestWithParam<GridModel> {};

TEST_P(SimulatedGrid, IntervalsCoverTheTruth) {
    const GridModel& model = GetParam();
    GridSimulator simulator(model);
    Coverage mean, minimum, maximum, uniformity, diversity;
    for (int run = 0; run < kGridRuns; ++run) {
        const GridSummary summary = simulator.run();
        mean.add(summary.mean, model.mean());
        minimum.add(summary.minimum, model.minimum());
        maximum.add(summary.maximum, model.maximum());
        uniformity.add(summary.uniformity, model.minimum() / model.mean());
        diversity.add(summary.diversity, model.minimum() / model.maximum());
    }
    EXPECT_NEAR(mean.share(), 0.95, 0.02);
    EXPECT_GE(minimum.share(), kLeastCoverage);
    EXPECT_GE(maximum.share(), kLeastCoverage);
    EXPECT_GE(uniformity.share(), kLeastCoverage);
    EXPECT_GE(diversity.share(), kLeastCoverage);
    RecordProperty("coverage",
                   testing::PrintToString(std::vector{mean.share(), minimum.share(), maximum.share(),
                                                      uniformity.share(), diversity.share()}));
    RecordProperty("half_widths",
                   testing::PrintToString(std::vector{mean.half_width, minimum.half_width, maximum.half_width,
                                                      uniformity.half_width, diversity.half_width}));
}

INSTANTIATE_TEST_SUITE_P(
    Models, SimulatedGrid,
    testing::Values(GridModel{"ties_64", equal_values(64)},
                    GridModel{"ties_64_16_replicates", equal_values(64), 16},
                    GridModel{"ties_64_correlated", equal_values(64), 32, 1, 0.9},
                    GridModel{"clear_64", clear_extremes(64)},
                    GridModel{"clear_64_correlated", clear_extremes(64), 32, 1, 0.9},
                    GridModel{"clear_64_large_errors", clear_extremes(64), 32, 20, 0.5},
                    GridModel{"bowl_64", bowl(64)}, GridModel{"bowl_64_correlated", bowl(64), 16, 1, 0.9},
                    GridModel{"two_readings", clear_extremes(2)},
                    GridModel{"ties_1024", equal_values(1024), 16},
                    GridModel{"clear_1024_correlated", clear_extremes(1024), 16, 1, 0.9}),
    [](const auto& tested) { return tested.param.name; });

TEST(GridSummary, ClearExtremesHaveNearlyThePlainInterval) {
    const GridModel model{"clear", clear_extremes(1024)};
    const GridSummary summary = GridSimulator(model).run();
    const double plain = student_t_quantile(0.975, 31);
    for (const Estimate& extreme : {summary.minimum, summary.maximum}) {
        const double half_width = (extreme.upper - extreme.lower) / 2;
        EXPECT_NEAR(half_width / (plain * extreme.standard_error), 1, 0.03);
        EXPECT_NEAR((extreme.upper + extreme.lower) / 2, extreme.value, 1e-9);
    }
}

TEST(GridSummary, CommonErrorsDoNotBlurAClearMinimum) {
    // Unpaired, the errors of 10 would hide the minimum that every single replicate shows.
    GridModel model{"common", equal_values(64), 32, 10, 0.9999};
    model.truth[5] = 99;
    const Estimate minimum = GridSimulator(model).run().minimum;
    const double half_width = (minimum.upper - minimum.lower) / 2;
    EXPECT_NEAR(half_width / (student_t_quantile(0.975, 31) * minimum.standard_error), 1, 0.03);
}

TEST(GridSummary, ValuesAreThePlainOnesOfTheMeans) {
    const std::vector<double> means{1, 4, 5, 3, 4, 7};
    const GridSummary summary = summarize_grid({means, 3});
    EXPECT_DOUBLE_EQ(summary.mean.value, 4);
    EXPECT_DOUBLE_EQ(summary.minimum.value, 2);
    EXPECT_DOUBLE_EQ(summary.minimum.standard_error, 1);
    EXPECT_DOUBLE_EQ(summary.maximum.value, 6);
    EXPECT_DOUBLE_EQ(summary.uniformity.value, 0.5);
    // Residuals of the minimum -1, 1, of the mean -2/3, 2/3; to first order dm/X - (m/X) dX/X.
    EXPECT_NEAR(summary.uniformity.standard_error, (1 - 1.0 / 3) / 4, 1e-12);
    // Of the maximum likewise -1, 1.
    EXPECT_DOUBLE_EQ(summary.diversity.value, 1.0 / 3);
    EXPECT_NEAR(summary.diversity.standard_error, (1 - 1.0 / 3) / 6, 1e-12);
}

/// They make up the standard errors that the summary states by other means.
TEST(GridSummary, ResidualsAreThoseOfTheErrors) {
    const GridModel model{"clear", clear_extremes(64), 16, 5, 0.5};
    const std::vector<double> means = GridSimulator(model).replicates();
    const ReplicateTable table{means, 64};
    const GridSummary summary = summarize_grid(table);
    for (std::size_t i = 0; i < kStatisticNames.size(); ++i) {
        const auto statistic = static_cast<Statistic>(i);
        const Estimate residual = estimate_from_replicates(residuals_of(table, statistic));
        EXPECT_NEAR(residual.value, 0, 1e-12) << name_of(statistic);
        EXPECT_NEAR(residual.standard_error, summary[statistic].standard_error,
                    1e-9 * residual.standard_error)
            << name_of(statistic);
    }
}

TEST(GridSummary, ExactReadingsHaveNoWidth) {
    const std::vector<double> means{0.1, 0.3, 0.2, 0.1, 0.3, 0.2, 0.1, 0.3, 0.2};
    const GridSummary summary = summarize_grid({means, 3});
    EXPECT_EQ(summary.minimum, (Estimate{0.1, 0, 0.1, 0.1}));
    EXPECT_EQ(summary.maximum, (Estimate{0.3, 0, 0.3, 0.3}));
}

TEST(GridSummary, DarknessHasNoUniformity) {
    const std::vector<double> means(6, 0.0);
    const GridSummary summary = summarize_grid({means, 3});
    EXPECT_EQ(summary.minimum, Estimate{});
    EXPECT_TRUE(std::isnan(summary.uniformity.value));
    EXPECT_TRUE(std::isnan(summary.uniformity.lower));
    EXPECT_TRUE(std::isnan(summary.diversity.value) && std::isnan(summary.diversity.upper));
    for (const double residual : residuals_of({means, 3}, Statistic::uniformity))
        EXPECT_TRUE(std::isnan(residual));
}

TEST(GridSummary, OneReadingIsItsOwnMinimumAndMaximum) {
    const std::vector<double> means{1, 2, 3, 4};
    const GridSummary summary = summarize_grid({means, 1});
    EXPECT_DOUBLE_EQ(summary.minimum.value, 2.5);
    EXPECT_DOUBLE_EQ(summary.maximum.value, 2.5);
    EXPECT_DOUBLE_EQ(summary.uniformity.value, 1);
    EXPECT_NEAR(summary.uniformity.standard_error, 0, 1e-15);
    EXPECT_DOUBLE_EQ(summary.diversity.value, 1);
    EXPECT_NEAR(summary.diversity.standard_error, 0, 1e-15);
}

}  // namespace
}  // namespace stilb::statistics
