#include "transport/glare/glare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/black.h"
#include "statistics/interval.h"
#include "support/scene_builder.h"

namespace stilb::transport {
namespace {

constexpr Vec3 kAhead{0, 1, 0};

/// The direction at an angle from the line of sight, in a plane at an angle from the vertical.
Vec3 direction_at(double from_sight_deg, double from_vertical_deg) {
    const double s = from_sight_deg * kPi / 180, t = from_vertical_deg * kPi / 180;
    return {std::sin(s) * std::sin(t), std::cos(s), std::sin(s) * std::cos(t)};
}

/// Guth's formula, computed by hand.
TEST(PositionIndex, IsThatOfGuth) {
    EXPECT_DOUBLE_EQ(position_index(kAhead, kAhead), 1);
    // t = 0: exp((35.2 - 1.22) 1e-3 30 + 21e-5 900)
    EXPECT_NEAR(position_index(direction_at(30, 0), kAhead), std::exp(1.0194 + 0.189), 1e-9);
    // t = 90: exp((35.2 - 28.7001 - 1.22 e^-20) 1e-3 30 + (21 + 24.0003 - 24.0003 - 0.0000) 1e-5 900)
    const double second = (21 + 0.26667 * 90 - 0.002963 * 8100) * 1e-5;
    EXPECT_NEAR(position_index(direction_at(30, 90), kAhead),
                std::exp((35.2 - 0.31889 * 90) * 1e-3 * 30 + second * 900), 1e-9);
    EXPECT_EQ(position_index(direction_at(30, 90), kAhead), position_index(direction_at(30, -90), kAhead));
}

TEST(PositionIndex, HasItsOwnFormulaBelowTheLineOfSight) {
    const double b = std::atan(std::tan(kPi / 6) * std::sqrt(1.3225)) * 180 / kPi;
    EXPECT_NEAR(position_index(direction_at(30, 180), kAhead), std::exp(6.49e-3 * b + 21e-5 * b * b), 1e-9);
}

TEST(PositionIndex, IsSixteenAtMost) {
    EXPECT_EQ(position_index(direction_at(85, 0), kAhead), 16);
    EXPECT_EQ(position_index(direction_at(120, 40), kAhead), 16);
}

/// By distances beside the line of sight and above it, per distance along it.
bool is_in_field_at(double beside, double above) {
    return is_in_field(normalized(Vec3{beside, 1, above}), kAhead);
}

/// Up to T / R = 3 and H / R = 2, where the index is still 15.8.
TEST(FieldOfUgr, EndsWhereTheTableOfPositionIndicesEnds) {
    EXPECT_TRUE(is_in_field_at(0, 0));
    constexpr double more = 1 + 1e-6;
    for (const double side : {-1, 1}) {
        EXPECT_TRUE(is_in_field_at(side * 3 / more, 0));
        EXPECT_TRUE(is_in_field_at(side * 3, 0));
        EXPECT_FALSE(is_in_field_at(side * 3 * more, 0));
        EXPECT_TRUE(is_in_field_at(3, side * 2 / more));
        EXPECT_TRUE(is_in_field_at(3, side * 2));
        EXPECT_FALSE(is_in_field_at(3, side * 2 * more));
    }
    // Straight above the line of sight: ln 16 = 33.98e-3 s + 21e-5 s^2.
    const double s = (-33.98e-3 + std::sqrt(33.98e-3 * 33.98e-3 + 4 * 21e-5 * std::log(16))) / (2 * 21e-5);
    EXPECT_TRUE(is_in_field(direction_at(s - 1e-6, 0), kAhead));
    EXPECT_FALSE(is_in_field(direction_at(s + 1e-6, 0), kAhead));
    EXPECT_FALSE(is_in_field(direction_at(90, 0), kAhead));
    EXPECT_FALSE(is_in_field({0, -1, 0}, kAhead));
    EXPECT_FALSE(is_in_field(normalized(Vec3{0.1, -1, 0.1}), kAhead));
}

/// A disk that faces the eye on its line of sight: solid angle, luminance and illuminance in closed form.
TEST(Glare, HasTheIntegralsOfADisk) {
    Scene scene;
    add_area_light(scene, Disk{{0, 2, 1.2}, {0, -1, 0}, 0.3}, Rgb::grey(5000));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const Glare glare = find_glare({{0, 0, 1.2}, kAhead}, scene, caster, lights, math::RandomKey{}, 8);
    ASSERT_EQ(glare.sources.size(), 1u);
    const double cosine = 2 / std::hypot(2, 0.3);
    EXPECT_NEAR(glare.sources[0].solid_angle_sr, 2 * kPi * (1 - cosine), 1e-5);
    EXPECT_NEAR(glare.sources[0].luminance_cd_m2, 5000, 1e-9);
    EXPECT_NEAR(glare.sources[0].position_index, 1, 1e-3);
    ASSERT_EQ(glare.direct_of_replicates_lx.size(), 8u);
    const statistics::Estimate direct = statistics::estimate_from_replicates(glare.direct_of_replicates_lx);
    EXPECT_NEAR(direct.value, kPi * 5000 * (1 - cosine * cosine), 0.02);
    const double sum = glare.sources[0].glare();
    const statistics::Estimate of_replicates =
        statistics::estimate_from_replicates(glare.sources[0].glare_of_replicates);
    EXPECT_NEAR(of_replicates.value, sum, 1e-3 * sum);
}

/// Half of a rectangle is hidden; a lamp behind the eye is none.
TEST(Glare, CountsWhatTheEyeSees) {
    Scene scene;
    add_area_light(scene, Rectangle{{-0.2, 3, 1}, {0.4, 0, 0}, {0, 0, 0.4}}, Rgb::grey(1000));
    add_area_light(scene, Disk{{0, -2, 1.2}, {0, 1, 0}, 0.3}, Rgb::grey(1000));
    add_object(scene, Rectangle{{-1, 2.999, 1}, {1, 0, 0}, {0, 0, 1}}, Black{});
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const Glare glare = find_glare({{0, 0, 1.2}, kAhead}, scene, caster, lights, math::RandomKey{}, 8);
    ASSERT_EQ(glare.sources.size(), 1u);
    EXPECT_NEAR(glare.sources[0].solid_angle_sr, 0.5 * 0.16 / 9, 2e-4);
    EXPECT_NEAR(glare.sources[0].luminance_cd_m2, 1000, 1e-9);
}

}  // namespace
}  // namespace stilb::transport
