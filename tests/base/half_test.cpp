#include "base/half.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stilb {
namespace {

TEST(Half, KeepsElevenBits) {
    for (float value = 1e-3F; value < 6e4F; value *= 1.37F)
        EXPECT_NEAR(to_float(to_half(value)), value, value * 0x1p-11F);
    EXPECT_EQ(to_float(to_half(-2.5F)), -2.5F);
    EXPECT_EQ(to_float(to_half(0)), 0);
}

TEST(Half, DoesNotOverflow) {
    EXPECT_EQ(to_float(to_half(1e9F)), 65504);
    EXPECT_EQ(to_float(to_half(-1e9F)), -65504);
    EXPECT_TRUE(std::isnan(to_float(to_half(NAN))));
}

}  // namespace
}  // namespace stilb
