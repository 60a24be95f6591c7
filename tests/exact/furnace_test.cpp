#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "exact/closed_rooms.h"

namespace stilb::exact {
namespace {

TEST(Furnace, EqualsItsNeumannSeries) {
    double sum = 0, order = 3;
    for (int reflections = 0; reflections < 400; ++reflections, order *= 0.9) sum += order;
    EXPECT_NEAR(furnace_luminance_cd_m2(3, 0.9), sum, 1e-12);
    EXPECT_NEAR(furnace_illuminance_lx(3, 0.9), std::numbers::pi * sum, 1e-12);
}

TEST(Furnace, RefusesArgumentsOutsideItsDomain) {
    EXPECT_THROW(furnace_luminance_cd_m2(1, 1), std::domain_error);
    EXPECT_THROW(furnace_luminance_cd_m2(1, -0.1), std::domain_error);
    EXPECT_THROW(furnace_illuminance_lx(-1, 0.5), std::domain_error);
}

}  // namespace
}  // namespace stilb::exact
