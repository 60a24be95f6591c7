// The holes of fabrics.
#include "materials/fabric.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace stilb::materials {
namespace {

double straight(double openness, double degrees) {
    return straight_transmittance(Fabric({openness, Rgb::grey(1), {}}), std::cos(degrees * kPi / 180))
        .luminance();
}

/// Values of the formula of Kotey, Wright, Collins, computed apart. At an openness of 0.05 the holes close at
/// 65.077 degrees.
TEST(Fabric, HolesCloseAtTheCutOff) {
    constexpr std::array<std::array<double, 2>, 4> shares{
        {{0, 0.05}, {30, 0.0420491}, {60, 0.0141843}, {65, 0.001154}}};
    for (const auto& [degrees, share] : shares) EXPECT_NEAR(straight(0.05, degrees), share, 5e-8) << degrees;
    EXPECT_GT(straight(0.05, 65.07), 0);
    EXPECT_EQ(straight(0.05, 65.08), 0);
}

TEST(Fabric, OfHolesOnlyLetsAllPass) {
    for (const double degrees : {0., 40., 89.}) {
        EXPECT_EQ(straight(1, degrees), 1);
        EXPECT_NEAR(straight(1 - 1e-9, degrees), 1, 0.01);
    }
}

/// Parts that send on nothing are no lobes.
TEST(Fabric, HasTheLobesThatItNeeds) {
    const auto count = [](double openness, double transmittance, double reflectance) {
        const Fabric fabric({openness, Rgb::grey(transmittance), Rgb::grey(reflectance)});
        return fabric.lobes(LightSide::outside, Carried::flux).size();
    };
    EXPECT_EQ(count(0.1, 0.3, 0.4), 3u);
    EXPECT_EQ(count(0.1, 0.1, 0.4), 2u);
    EXPECT_EQ(count(0, 0.3, 0), 1u);
}

}  // namespace
}  // namespace stilb::materials
