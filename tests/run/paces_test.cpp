// Paces from the spread of replicates.
#include "run/paces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace stilb::run {
namespace {

constexpr std::size_t kReplicates = 8, kReadings = 40;
constexpr std::uint64_t kSamples = 16;

/// Means of 100 and, with signs that change from replicate to replicate, these deviations in packets of ten
/// readings.
std::vector<double> table_of(const std::array<double, 4>& deviations) {
    std::vector<double> means;
    for (std::size_t r = 0; r < kReplicates; ++r) {
        for (std::size_t j = 0; j < kReadings; ++j)
            means.push_back(100 + deviations[j / 10] * (r % 2 == 0 ? 1 : -1));
    }
    return means;
}

std::vector<estimators::Pace> paces(std::size_t replicate, const std::vector<double>& means,
                                    std::vector<std::size_t> sensors = {kReadings}) {
    std::vector<std::uint32_t> packets(kReadings);
    for (std::size_t j = 0; j < kReadings; ++j) packets[j] = static_cast<std::uint32_t>(j / 10);
    return paces_of(replicate, {means, kReadings}, packets, sensors, kSamples, 2);
}

TEST(Paces, FollowTheVariances) {
    const auto all = paces(0, table_of({8, 4, 2, 0.1}));
    ASSERT_EQ(all.size(), 4u);
    for (const estimators::Pace& pace : all) EXPECT_EQ(pace.all, kSamples);
    EXPECT_EQ(all[0].every, 1u);
    EXPECT_EQ(all[1].every, 2u);  // a quarter of the variance, with twice what it needs
    EXPECT_EQ(all[2].every, 8u);
    EXPECT_EQ(all[3].every, 16u);
}

TEST(Paces, AreOneWhereAllAreAlike) {
    for (const estimators::Pace& pace : paces(3, table_of({2, 2, 2, 2}))) EXPECT_EQ(pace.every, 1u);
}

TEST(Paces, TakeAllWhereNothingHasBeenFound) {
    std::vector<double> means = table_of({8, 4, 0, 1});
    EXPECT_EQ(paces(0, means)[2].every, 1u);
    std::ranges::fill(means, 0.0);
    for (const estimators::Pace& pace : paces(0, means)) EXPECT_EQ(pace.every, 1u);
}

/// Packets in a cupboard, whose values are noise about 0, need no more samples than others.
TEST(Paces, OfDarkReadingsFollowTheirAbsoluteVariances) {
    std::vector<double> means = table_of({8, 4, 2, 1});
    for (std::size_t r = 0; r < kReplicates; ++r) {
        for (std::size_t j = 30; j < kReadings; ++j) means[r * kReadings + j] -= 100;
    }
    const auto all = paces(0, means);
    EXPECT_EQ(all[0].every, 16u) << "1 beside a hundredth of 75 decides";
    EXPECT_EQ(all[3].every, 1u);
    for (std::size_t r = 0; r < kReplicates; ++r) {
        for (std::size_t j = 30; j < kReadings; ++j) means[r * kReadings + j] *= 1e-3;
    }
    const auto darker = paces(0, means);
    EXPECT_EQ(darker[0].every, 1u);
    EXPECT_EQ(darker[3].every, 16u);
}

TEST(Paces, AreOneWhereTheOthersAreEqual) {
    const std::vector<double> means(kReplicates * kReadings, 0.1);
    for (const estimators::Pace& pace : paces(0, means)) EXPECT_EQ(pace.every, 1u);
}

TEST(Paces, DoNotDependOnTheReplicateItself) {
    const std::vector<double> means = table_of({8, 4, 2, 1});
    for (std::size_t r = 0; r < kReplicates; ++r) {
        std::vector<double> changed = means;
        for (std::size_t j = 0; j < kReadings; ++j) changed[r * kReadings + j] = 1e6 * static_cast<double>(j);
        const auto before = paces(r, means), after = paces(r, changed);
        for (std::size_t p = 0; p < before.size(); ++p) EXPECT_EQ(before[p].every, after[p].every);
    }
}

TEST(Paces, OfSureSensorsFollowTheOther) {
    const auto all = paces(0, table_of({8, 8, 2, 2}), {20, 20});
    EXPECT_EQ(all[0].every, 1u);
    EXPECT_EQ(all[2].every, 8u);
}

}  // namespace
}  // namespace stilb::run
