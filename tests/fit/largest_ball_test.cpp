#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit/star_center.h"
#include "support/harmonic_shapes.h"

namespace stilb::fit {
namespace {

double room_at(const std::vector<HalfSpace>& walls, const Vec3& x) {
    double room = INFINITY;
    for (const HalfSpace& wall : walls) room = std::min(room, wall.offset - dot(wall.normal, x));
    return room;
}

std::vector<HalfSpace> box_walls(const Vec3& half) {
    return {{{1, 0, 0}, half.x},  {{-1, 0, 0}, half.x}, {{0, 1, 0}, half.y},
            {{0, -1, 0}, half.y}, {{0, 0, 1}, half.z},  {{0, 0, -1}, half.z}};
}

TEST(LargestBall, OfACubeTouchesItsSides) {
    const InnerBall ball = largest_ball(box_walls({1, 1, 1}), 2);
    EXPECT_NEAR(ball.radius, 1, 2e-6);
    EXPECT_NEAR(length(ball.center), 0, 4e-6);
}

TEST(LargestBall, OfALongBoxIsAsHighAsTheBox) {
    EXPECT_NEAR(largest_ball(box_walls({7, 5, 0.25}), 10).radius, 0.25, 1e-5);
}

/// Walls that touch a known ball from outside, all round, and others farther away.
TEST(LargestBall, IsFoundAmongManyWalls) {
    Numbers numbers(5);
    for (int round = 0; round < 20; ++round) {
        const Vec3 center = 0.4 * numbers.direction();
        const double radius = 0.1 + 0.4 * numbers.next();
        std::vector<HalfSpace> walls;
        for (int i = 0; i < 3000; ++i) {
            const Vec3 normal = numbers.direction();
            const double farther = i < 100 ? 0 : numbers.next();
            walls.push_back({normal, dot(normal, center) + radius + farther});
        }
        const InnerBall ball = largest_ball(walls, 2);
        EXPECT_NEAR(ball.radius, radius, 2e-6);
        EXPECT_NEAR(length(ball.center - center), 0, 2e-5);
    }
}

TEST(LargestBall, HasNoBetterCentreNearby) {
    Numbers numbers(6);
    for (int round = 0; round < 50; ++round) {
        std::vector<HalfSpace> walls;
        for (int i = 0; i < 40; ++i) walls.push_back({numbers.direction(), numbers.next() - 0.2});
        const InnerBall ball = largest_ball(walls, 2);
        EXPECT_NEAR(ball.radius, room_at(walls, ball.center), 1e-11);
        for (int i = 0; i < 2000; ++i) {
            const Vec3 other = ball.center + std::pow(10, -5 * numbers.next()) * numbers.direction();
            EXPECT_LT(room_at(walls, other), ball.radius + 2e-6);
        }
    }
}

TEST(LargestBall, HasANegativeRadiusWhereWallsHaveNothingInCommon) {
    std::vector<HalfSpace> walls = box_walls({3, 3, 3});
    walls.push_back({{1, 0, 0}, -0.5});   // x <= -0.5
    walls.push_back({{-1, 0, 0}, -1.5});  // x >= 1.5
    const InnerBall ball = largest_ball(walls, 6);
    EXPECT_NEAR(ball.radius, -1, 1e-5);
    EXPECT_NEAR(ball.center.x, 0.5, 1e-5);
}

TEST(LargestBall, StaysWithinReachWhereNothingHoldsIt) {
    EXPECT_LT(length(largest_ball(std::vector<HalfSpace>{}, 2).center), 6);
    const std::vector<HalfSpace> floor{{{0, 0, -1}, 0}};
    const InnerBall ball = largest_ball(floor, 2);
    EXPECT_GT(ball.radius, 0.5);
    EXPECT_LT(length(ball.center), 6);
}

}  // namespace
}  // namespace stilb::fit
