#include "support/moments.h"

#include <gtest/gtest.h>

namespace stilb::statistics {
namespace {

RunningMoments moments_of(std::initializer_list<double> values) {
    RunningMoments moments;
    for (const double value : values) moments.add(value);
    return moments;
}

TEST(RunningMoments, EmptyAndSingleStreamsHaveNoSpread) {
    EXPECT_EQ(RunningMoments{}.mean(), 0);
    EXPECT_EQ(moments_of({3}).mean(), 3);
    EXPECT_EQ(moments_of({3}).variance(), 0);
    EXPECT_EQ(moments_of({3}).standard_error(), 0);
}

TEST(RunningMoments, HasTheUnbiasedVariance) {
    const RunningMoments moments = moments_of({2, 4, 4, 4, 5, 5, 7, 9});
    EXPECT_EQ(moments.count(), 8U);
    EXPECT_DOUBLE_EQ(moments.mean(), 5);
    EXPECT_DOUBLE_EQ(moments.variance(), 32.0 / 7);
    EXPECT_DOUBLE_EQ(moments.standard_error(), std::sqrt(32.0 / 7 / 8));
}

TEST(RunningMoments, StaysExactWhereTheMeanIsLarge) {
    EXPECT_DOUBLE_EQ(moments_of({1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}).variance(), 30);
}

TEST(RunningMoments, MergesAsIfBothStreamsWereOne) {
    RunningMoments merged = moments_of({1, 2, 10});
    merged.merge(moments_of({-3, 8}));
    const RunningMoments whole = moments_of({1, 2, 10, -3, 8});
    EXPECT_EQ(merged.count(), whole.count());
    EXPECT_DOUBLE_EQ(merged.mean(), whole.mean());
    EXPECT_DOUBLE_EQ(merged.variance(), whole.variance());
}

TEST(RunningMoments, MergesWithEmptyStreams) {
    RunningMoments left = moments_of({1, 2, 6});
    left.merge(RunningMoments{});
    RunningMoments right;
    right.merge(left);
    EXPECT_DOUBLE_EQ(right.mean(), 3);
    EXPECT_DOUBLE_EQ(right.variance(), 7);
}

}  // namespace
}  // namespace stilb::statistics
