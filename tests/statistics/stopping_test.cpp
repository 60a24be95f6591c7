#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "statistics/interval.h"

namespace stilb::statistics {
namespace {

std::vector<Estimate> readings_with_half_widths(std::initializer_list<double> half_widths) {
    std::vector<Estimate> readings;
    for (const double h : half_widths) readings.push_back({.value = 1, .lower = 1 - h, .upper = 1 + h});
    return readings;
}

TEST(Stopping, AttainsWhatTheShareOfTheReadingsAttains) {
    std::vector<Estimate> readings;
    for (int i = 20; i >= 1; --i) readings.push_back({.value = 100, .lower = 100.0 - i, .upper = 100.0 + i});
    EXPECT_NEAR(attained_error(readings), 0.19, 1e-12);
    EXPECT_NEAR(attained_error(readings, 1), 0.20, 1e-12);
    EXPECT_NEAR(attained_error(readings, 0.5), 0.10, 1e-12);
    EXPECT_NEAR(attained_error(readings, 0.51), 0.11, 1e-12);
}

TEST(Stopping, AFewReadingsMustAllMeetTheTarget) {
    const std::vector<Estimate> readings = readings_with_half_widths({0.01, 0.02, 0.5});
    EXPECT_NEAR(attained_error(readings), 0.5, 1e-12);
}

TEST(Stopping, DarkReadingsAndNoReadingsAreDone) {
    const std::vector<Estimate> dark(3);
    EXPECT_EQ(attained_error(dark), 0);
    EXPECT_EQ(attained_error({}), 0);
    const std::vector<Estimate> unknown{{.value = 0, .lower = -1, .upper = 1}};
    EXPECT_GT(attained_error(unknown), 1e9);
}

/// Errors are relative to a hundredth of the mean at least.
TEST(Stopping, ErrorsOfDarkReadingsAreAbsolute) {
    std::vector<Estimate> readings(99, {.value = 100, .lower = 99, .upper = 101});
    const auto error_of_last = [&](double value) {
        readings.push_back({.value = value, .lower = value - 0.5, .upper = value + 0.5});
        const double error = attained_error(readings, 1);
        readings.pop_back();
        return error;
    };
    const double level = 0.01 * 100 * 99 / (100 - 0.01);  // a reading that is 1 % of the mean
    EXPECT_NEAR(error_of_last(level), 0.5 / level, 1e-9);
    EXPECT_NEAR(error_of_last(1.01 * level), 0.5 / (1.01 * level), 1e-9);
    EXPECT_NEAR(error_of_last(0.99 * level), 0.5 / level, 1e-4);
    EXPECT_NEAR(error_of_last(0), 0.5 / 0.99, 1e-9);
    EXPECT_NEAR(error_of_last(-0.3), 0.5 / (0.01 * (9900 - 0.3) / 100), 1e-9);
}

TEST(Stopping, APointInACupboardDoesNotDecide) {
    std::vector<Estimate> readings(80, {.value = 100, .lower = 99, .upper = 101});
    readings.resize(100, {.value = 1e-3, .lower = 0, .upper = 2e-3});
    EXPECT_NEAR(attained_error(readings), 0.01, 1e-9);
    EXPECT_DOUBLE_EQ(dark_level(readings), 0.01 * (0.8 * 100 + 0.2 * 1e-3));
}

/// A reading of true value 1 from 32 replicates of light paths, checked at growing sizes until it meets the
/// target.
class StoppedRun {
  public:
    StoppedRun(std::function<double(std::mt19937_64&)> draw_light_path, double growth)
        : draw_light_path_(std::move(draw_light_path)), growth_(growth) {}

    double coverage(double target) {
        constexpr int kRuns = 2000;
        int held = 0;
        for (int run = 0; run < kRuns; ++run) {
            const Estimate estimate = stop_at(target);
            held += estimate.lower <= 1 && 1 <= estimate.upper ? 1 : 0;
        }
        return held / double{kRuns};
    }

  private:
    Estimate stop_at(double target) {
        std::vector<double> sums(32, 0.0), means(32);
        int light_paths = 0;
        // Where the sizes lie beside the one needed is random, as it is in practice.
        double size = 8 * std::pow(growth_, std::uniform_real_distribution<double>()(random_));
        for (;; size *= growth_) {
            const int upto = static_cast<int>(size);
            for (std::size_t r = 0; r < sums.size(); ++r) {
                for (int path = light_paths; path < upto; ++path) sums[r] += draw_light_path_(random_);
                means[r] = sums[r] / upto;
            }
            light_paths = upto;
            const Estimate estimate = estimate_from_replicates(means, kStoppedConfidence);
            if (attained_error({&estimate, 1}) <= target) return estimate;
        }
    }

    std::function<double(std::mt19937_64&)> draw_light_path_;
    double growth_;
    std::mt19937_64 random_{17};
};

/// The dim tenth has wide intervals: it decides by its number, but not by its weight.
TEST(Stopping, WeightsSayWhoDecides) {
    std::vector<double> half_widths(9, 0.02), weights(9, 100);
    half_widths.push_back(1);
    weights.push_back(1);
    EXPECT_DOUBLE_EQ(attained_error_of(half_widths), 1);
    EXPECT_DOUBLE_EQ(attained_error_of(half_widths, weights), 0.02);
    EXPECT_DOUBLE_EQ(attained_error_of(half_widths, std::vector<double>(10, 1.0)), 1);
    EXPECT_EQ(attained_error_of({}, {}, 0.95), 0);
}

TEST(Stopping, LooksAtPowersOfTwoAndBetween) {
    std::vector<std::uint64_t> looks;
    for (std::uint64_t done = 0; done < 256; done = looks.back()) looks.push_back(next_check(done, 32));
    EXPECT_EQ(looks, (std::vector<std::uint64_t>{32, 48, 64, 96, 128, 192, 256}));
    EXPECT_EQ(next_check(33, 32), 48u);
}

TEST(Stopping, IntervalsHoldThoughTheRunStopsWhereTheyAreNarrow) {
    const auto normal = [](std::mt19937_64& random) {
        return std::normal_distribution<double>(1, 1)(random);
    };
    const auto skewed = [](std::mt19937_64& random) {
        return std::exponential_distribution<double>(1)(random);
    };
    for (const double growth : {1.5, 2.0}) {
        EXPECT_GE(StoppedRun(normal, growth).coverage(0.07), 0.94) << growth;
        EXPECT_GE(StoppedRun(skewed, growth).coverage(0.07), 0.94) << growth;
    }
}

/// A reading of true value 0 from replicates of normal samples, of which each has as many as runs have at
/// their checks, 1, 1.5, 2, 3 ... times as many as at the first one, where the reading has an error of 1.
class RequiredRun {
  public:
    explicit RequiredRun(std::size_t replicates)
        : sums_(replicates),
          error_(std::sqrt(static_cast<double>(replicates))),
          deciding_(quantile(kVerdictConfidence)),
          stated_(quantile(kDecidedConfidence)) {}

    /// At the first check at which a requirement is decided, or at the last one.
    struct Ending {
        bool is_decided = false;
        bool interval_holds = false;
    };
    Ending run(double required, int checks) {
        std::ranges::fill(sums_, 0);
        std::uint64_t samples = 0;
        for (int check = 1;; ++check) {
            const std::uint64_t next = next_check(samples, kFirst);
            const ReplicateMoments moments = grow(samples, next);
            samples = next;
            const double mean = moments.means.front(), error = moments.errors.standard_errors.front();
            const bool is_decided = std::abs(mean - required) > deciding_ * error;
            if (is_decided || check == checks) return {is_decided, std::abs(mean) <= stated_ * error};
        }
    }

  private:
    static constexpr std::uint64_t kFirst = 16;

    double quantile(double confidence) const {
        return student_t_quantile((1 + confidence) / 2, static_cast<int>(sums_.size()) - 1);
    }
    /// The moments after `to` samples of each replicate.
    ReplicateMoments grow(std::uint64_t from, std::uint64_t to) {
        std::vector<double> means;
        const double more = static_cast<double>(to - from) / kFirst;
        for (double& sum : sums_) {
            sum += error_ * std::sqrt(more) * normal_(random_);
            means.push_back(sum * kFirst / static_cast<double>(to));
        }
        return compute_replicate_moments({means, 1});
    }

    std::vector<double> sums_;
    double error_, deciding_, stated_;
    std::mt19937_64 random_{29};
    std::normal_distribution<double> normal_;
};

/// Where exactly the true value is required, every verdict is by chance. 30 checks are 30,000 times as many
/// samples as at the first one.
TEST(Stopping, VerdictsAreSeldomByChanceThoughTheRunLooksAgainAndAgain) {
    for (const std::size_t replicates : {8U, 32U}) {
        RequiredRun runs(replicates);
        constexpr int kRuns = 4000;
        int decided = 0;
        for (int run = 0; run < kRuns; ++run) decided += runs.run(0, 30).is_decided;
        EXPECT_LE(decided, 0.05 * kRuns) << replicates;
        EXPECT_GE(decided, 0.01 * kRuns) << "the test would find a rule that never decides";
    }
}

/// Whatever the distance of the requirement, in errors of the first check.
TEST(Stopping, IntervalsHoldThoughTheRunStopsByAVerdict) {
    for (const double distance : {0.2, 0.4, 0.6, 1., 2., 3., 4., 6.}) {
        RequiredRun runs(32);
        constexpr int kRuns = 2000;
        int held = 0;
        for (int run = 0; run < kRuns; ++run) held += runs.run(-distance, 30).interval_holds;
        EXPECT_GE(held / double{kRuns}, 0.935) << distance;
        EXPECT_LE(held / double{kRuns}, 0.99) << distance;
    }
}

}  // namespace
}  // namespace stilb::statistics
