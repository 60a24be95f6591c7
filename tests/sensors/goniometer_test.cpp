#include "sensors/goniometer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stilb::sensors {
namespace {

Goniometer goniometer(const Vec3& normal, std::optional<double> plane_deg, double step_deg) {
    return {{1, 2, 3}, normal, plane_deg, step_deg};
}

EmergentRay ray(const Goniometer& sensor, std::size_t j) {
    return std::get<EmergentRay>(sensor.measurand(j));
}

void expect_same_place(const Vec3& a, const Vec3& b) {
    EXPECT_LT(length(a - b), 1e-12) << "(" << a.x << ", " << a.y << ", " << a.z << ")";
}

TEST(Goniometer, APolarPlaneReachesFromSideToSide) {
    const Goniometer sensor = goniometer({0, 0, 1}, 0, 30);
    ASSERT_EQ(sensor.size(), 5u);
    const double theta_deg[] = {-60, -30, 0, 30, 60};
    for (std::size_t j = 0; j < 5; ++j) {
        EXPECT_EQ(sensor.angles(j).theta_deg, theta_deg[j]);
        EXPECT_EQ(sensor.angles(j).phi_deg, 0);
        EXPECT_EQ(ray(sensor, j).position, (Vec3{1, 2, 3}));
        EXPECT_EQ(ray(sensor, j).normal, (Vec3{0, 0, 1}));
    }
    expect_same_place(ray(sensor, 0).direction, {-std::sqrt(0.75), 0, 0.5});
    expect_same_place(ray(sensor, 2).direction, {0, 0, 1});
    expect_same_place(ray(sensor, 3).direction, {0.5, 0, std::sqrt(0.75)});
}

TEST(Goniometer, PositiveAnglesLieTowardsTheAzimuth) {
    expect_same_place(ray(goniometer({0, 0, 1}, 90, 45), 2).direction, {0, std::sqrt(0.5), std::sqrt(0.5)});
    expect_same_place(ray(goniometer({0, 0, 1}, 180, 45), 2).direction, {-std::sqrt(0.5), 0, std::sqrt(0.5)});
}

TEST(Goniometer, OtherNormalsAreReachedByTheShortestTurn) {
    // +z to +x turns about the y axis: azimuth 0, which was +x, becomes -z; azimuth 90 stays.
    expect_same_place(ray(goniometer({1, 0, 0}, 0, 45), 2).direction, {std::sqrt(0.5), 0, -std::sqrt(0.5)});
    expect_same_place(ray(goniometer({1, 0, 0}, 90, 45), 2).direction, {std::sqrt(0.5), std::sqrt(0.5), 0});
    // +z to -z: half a turn about the x axis.
    expect_same_place(ray(goniometer({0, 0, -1}, 0, 45), 2).direction, {std::sqrt(0.5), 0, -std::sqrt(0.5)});
    expect_same_place(ray(goniometer({0, 0, -1}, 90, 45), 2).direction,
                      {0, -std::sqrt(0.5), -std::sqrt(0.5)});
}

TEST(Goniometer, LeavesOutGrazingDirections) {
    for (const double step_deg : {90.0, 7.0, 5.0, 1.0, 0.1, 0.3, 90.0 / 7}) {
        for (const std::optional<double> plane : {std::optional<double>{}, std::optional{20.0}}) {
            if (!plane && step_deg < 1) continue;
            const Goniometer sensor = goniometer(normalized(Vec3{1, 2, -2}), plane, step_deg);
            for (std::size_t j = 0; j < sensor.size(); ++j) {
                const EmergentRay r = ray(sensor, j);
                EXPECT_GT(dot(r.direction, r.normal), 1e-6);
                EXPECT_NEAR(length(r.direction), 1, 1e-14);
            }
            EXPECT_GE(sensor.angles(sensor.size() - 1).theta_deg, 90 - step_deg - 1e-9) << "nor others";
        }
    }
    EXPECT_EQ(goniometer({0, 0, 1}, 0, 90).size(), 1u);
}

TEST(Goniometer, WithoutAPlaneItMeasuresTheHemisphere) {
    const Goniometer sensor = goniometer({0, 0, 1}, {}, 45);
    ASSERT_EQ(sensor.size(), 9u) << "the pole once";
    EXPECT_EQ(sensor.angles(0).theta_deg, 0);
    for (std::size_t j = 1; j < 9; ++j) {
        EXPECT_EQ(sensor.angles(j).theta_deg, 45);
        EXPECT_EQ(sensor.angles(j).phi_deg, 45 * (static_cast<double>(j) - 1));
    }
    expect_same_place(ray(sensor, 3).direction, {0, std::sqrt(0.5), std::sqrt(0.5)});
}

TEST(Goniometer, ThetaRisesAndForEachThetaPhi) {
    for (const double step_deg : {45.0, 7.0, 2.0}) {
        const Goniometer asked = goniometer({0, 0, 1}, {}, step_deg);
        for (std::size_t j = 1; j < asked.size(); ++j) {
            const PolarAngles last = asked.angles(j - 1), next = asked.angles(j);
            if (next.phi_deg > 0) {
                EXPECT_EQ(next.theta_deg, last.theta_deg);
                EXPECT_NEAR(next.phi_deg - last.phi_deg, step_deg, 1e-9);
            } else {
                EXPECT_NEAR(next.theta_deg - last.theta_deg, step_deg, 1e-9);
                if (j > 1) {
                    EXPECT_GE(last.phi_deg, 360 - step_deg - 1e-9);
                }
            }
        }
    }
}

TEST(Goniometer, SaysHowManyDirectionsAreTooMany) {
    EXPECT_GT(goniometer({0, 0, 1}, {}, 0.001).size(), 3'000'000'000);
    const auto fault = goniometer({0, 0, 1}, {}, 0.001).settle(GivenKeys({"step"}));
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->key, "step");
    EXPECT_FALSE(goniometer({0, 0, 1}, {}, 0.1).settle(GivenKeys({"step"})));
}

}  // namespace
}  // namespace stilb::sensors
