#include <gtest/gtest.h>

#include <array>

#include "base/vec.h"

namespace stilb::math {
namespace {

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT(length(a - b), 1e-15); }

TEST(FrameOfSurface, IsHorizontalAndUpwards) {
    const Frame wall = Frame::of_surface({1, 0, 0});
    expect_near(wall.u, {0, 1, 0});
    expect_near(wall.v, {0, 0, 1});
    const Frame floor = Frame::of_surface({0, 0, 1});
    expect_near(floor.u, {1, 0, 0});
    expect_near(floor.v, {0, 1, 0});
    const Frame ceiling = Frame::of_surface({0, 0, -1});
    expect_near(ceiling.u, {1, 0, 0});
    expect_near(ceiling.v, {0, -1, 0});
}

TEST(FrameOfSurface, IsOrthonormalAndRightHanded) {
    for (const double tilt : {0.0, 1e-12, 1e-6, 0.99e-5, 1.01e-5, 1e-3, 0.7, 1.5707}) {
        for (const double azimuth : {0.0, 1.0, 2.5, -2.0}) {
            for (const double sign : {1.0, -1.0}) {
                const Vec3 n = normalized(Vec3{std::sin(tilt) * std::cos(azimuth),
                                               std::sin(tilt) * std::sin(azimuth), sign * std::cos(tilt)});
                const Frame frame = Frame::of_surface(n);
                EXPECT_NEAR(dot(frame.u, frame.v), 0, 1e-15);
                EXPECT_NEAR(dot(frame.u, n), 0, 1e-15);
                EXPECT_NEAR(length(frame.u), 1, 1e-15);
                expect_near(cross(frame.u, frame.v), n);
                EXPECT_NEAR(frame.u.z, 0, 1e-5);
            }
        }
    }
}

}  // namespace
}  // namespace stilb::math
