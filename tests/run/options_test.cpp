#include "run/options.h"

#include <gtest/gtest.h>

namespace stilb::run {
namespace {

TEST(RelativeError, IsAShareOrPerCent) {
    EXPECT_EQ(parse_relative_error("0.01"), 0.01);
    EXPECT_EQ(parse_relative_error("1%"), 0.01);
    EXPECT_EQ(parse_relative_error("0.2%"), 0.002);
    EXPECT_EQ(parse_relative_error("5e-3"), 0.005);
}

TEST(RelativeError, RefusesWhatIsNotBetween0And1) {
    for (const char* text : {"", "%", "1", "100%", "0", "-1%", "nan", "inf", "1 %", "1%%", "one", "0x1p-3"}) {
        EXPECT_FALSE(parse_relative_error(text)) << text;
    }
}

}  // namespace
}  // namespace stilb::run
