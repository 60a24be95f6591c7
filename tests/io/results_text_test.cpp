#include "io/results/results_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace stilb::io {
namespace {

TEST(ResultsText, PercentHasTwoDigitsOrAllBeforeThePoint) {
    EXPECT_EQ(percent(0.00654), "0.65 %");
    EXPECT_EQ(percent(0.99), "99 %");
    EXPECT_EQ(percent(0.996), "100 %");
    EXPECT_EQ(percent(3.14), "314 %");
    EXPECT_EQ(percent(std::numeric_limits<double>::infinity()), "inf %");
}

}  // namespace
}  // namespace stilb::io
