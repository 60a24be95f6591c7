#include "sensors/goniometer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stilb::sensors {
namespace {

Sensor goniometer(const Vec3& normal, std::optional<double> plane_deg, double step_deg) {
    return make_goniometer_sensor("probe", {{1, 2, 3}, normal, plane_deg, step_deg});
}

EmergentRay ray(const Sensor& sensor, std::size_t j) { return std::get<EmergentRay>(sensor.measurands[j]); }

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_LT(length(a - b), 1e-12) << "(" << a.x << ", " << a.y << ", " << a.z << ")";
}

TEST(Goniometer, APolarPlaneReachesFromSideToSide) {
    const Sensor sensor = goniometer({0, 0, 1}, 0, 30);
    ASSERT_EQ(sensor.measurands.size(), 5u);
    ASSERT_EQ(sensor.angles.size(), 5u);
    const double theta_deg[] = {-60, -30, 0, 30, 60};
    for (std::size_t j = 0; j < 5; ++j) {
        EXPECT_EQ(sensor.angles[j].theta_deg, theta_deg[j]);
        EXPECT_EQ(sensor.angles[j].phi_deg, 0);
        EXPECT_EQ(ray(sensor, j).position, (Vec3{1, 2, 3}));
        EXPECT_EQ(ray(sensor, j).normal, (Vec3{0, 0, 1}));
    }
    expect_near(ray(sensor, 0).direction, {-std::sqrt(0.75), 0, 0.5});
    expect_near(ray(sensor, 2).direction, {0, 0, 1});
    expect_near(ray(sensor, 3).direction, {0.5, 0, std::sqrt(0.75)});
}

TEST(Goniometer, PositiveAnglesLieTowardsTheAzimuth) {
    expect_near(ray(goniometer({0, 0, 1}, 90, 45), 2).direction, {0, std::sqrt(0.5), std::sqrt(0.5)});
    expect_near(ray(goniometer({0, 0, 1}, 180, 45), 2).direction, {-std::sqrt(0.5), 0, std::sqrt(0.5)});
}

TEST(Goniometer, OtherNormalsAreReachedByTheShortestTurn) {
    // +z to +x turns about the y axis: azimuth 0, which was +x, becomes -z; azimuth 90 stays.
    expect_near(ray(goniometer({1, 0, 0}, 0, 45), 2).direction, {std::sqrt(0.5), 0, -std::sqrt(0.5)});
    expect_near(ray(goniometer({1, 0, 0}, 90, 45), 2).direction, {std::sqrt(0.5), std::sqrt(0.5), 0});
    // +z to -z: half a turn about the x axis.
    expect_near(ray(goniometer({0, 0, -1}, 0, 45), 2).direction, {std::sqrt(0.5), 0, -std::sqrt(0.5)});
    expect_near(ray(goniometer({0, 0, -1}, 90, 45), 2).direction, {0, -std::sqrt(0.5), -std::sqrt(0.5)});
}

TEST(Goniometer, LeavesOutGrazingDirections) {
    for (const double step_deg : {90.0, 7.0, 5.0, 1.0, 0.1, 0.3, 90.0 / 7}) {
        for (const std::optional<double> plane : {std::optional<double>{}, std::optional{20.0}}) {
            if (!plane && step_deg < 1) continue;
            const Sensor sensor = goniometer(normalized(Vec3{1, 2, -2}), plane, step_deg);
            for (std::size_t j = 0; j < sensor.measurands.size(); ++j) {
                const EmergentRay& r = ray(sensor, j);
                EXPECT_GT(dot(r.direction, r.normal), 1e-6);
                EXPECT_NEAR(length(r.direction), 1, 1e-14);
            }
            EXPECT_GE(sensor.angles.back().theta_deg, 90 - step_deg - 1e-9) << "nor others";
        }
    }
    EXPECT_EQ(goniometer({0, 0, 1}, 0, 90).measurands.size(), 1u);
}

TEST(Goniometer, WithoutAPlaneItMeasuresTheHemisphere) {
    const Sensor sensor = goniometer({0, 0, 1}, {}, 45);
    ASSERT_EQ(sensor.measurands.size(), 9u) << "the pole once";
    EXPECT_EQ(sensor.angles[0].theta_deg, 0);
    for (std::size_t j = 1; j < 9; ++j) {
        EXPECT_EQ(sensor.angles[j].theta_deg, 45);
        EXPECT_EQ(sensor.angles[j].phi_deg, 45 * (static_cast<double>(j) - 1));
    }
    expect_near(ray(sensor, 3).direction, {0, std::sqrt(0.5), std::sqrt(0.5)});
}

TEST(Goniometer, CountsItsDirectionsBeforehand) {
    for (const double step_deg : {90.0, 45.0, 7.0, 2.0}) {
        for (const std::optional<double> plane : {std::optional<double>{}, std::optional{0.0}}) {
            const Goniometer asked{{0, 0, 0}, {0, 0, 1}, plane, step_deg};
            EXPECT_EQ(static_cast<std::size_t>(direction_count(asked)),
                      make_goniometer_sensor("", asked).measurands.size());
        }
    }
    EXPECT_GT(direction_count({{}, {0, 0, 1}, {}, 0.001}), 3'000'000'000);
}

}  // namespace
}  // namespace stilb::sensors
