#include "sensors/camera.h"

#include <gtest/gtest.h>

namespace stilb::sensors {
namespace {

constexpr double kDegree = kPi / 180;

/// Looks along +y from (1, 2, 3), with +x to the right.
Camera camera(Projection projection, double fov_deg, std::array<int, 2> resolution) {
    return {{1, 2, 3}, {1, 7, 3}, {0, 0, 1}, fov_deg, resolution, projection};
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
    EXPECT_LT(length(a - b), tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ")";
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

/// Of the spherical triangle [Van Oosterom, Strackee 1983, The solid angle of a plane triangle].
double solid_angle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Of all pixels whose corners the picture shows.
double solid_angle_of_pixels(const Camera& camera) {
    const CameraView view(camera);
    const auto [width, height] = camera.resolution;
    double sum = 0;
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const auto a = view.direction_at(i, j), b = view.direction_at(i + 1, j);
            const auto c = view.direction_at(i + 1, j + 1), d = view.direction_at(i, j + 1);
            if (a && b && c && d) sum += solid_angle_of(*a, *b, *c) + solid_angle_of(*a, *c, *d);
        }
    }
    return sum;
}

TEST(CameraView, HasAxesToTheRightUpAndForward) {
    const CameraView view(camera(Projection::perspective, 90, {4, 2}));
    expect_near(view.position(), {1, 2, 3});
    expect_near(view.forward(), {0, 1, 0});
    expect_near(view.right(), {1, 0, 0});
    expect_near(view.up(), {0, 0, 1});
}

TEST(CameraView, UpNeedNotBeAtRightAnglesToTheView) {
    const CameraView view({{0, 0, 0}, {3, 0, -4}, {0, 0, 5}, 60, {1, 1}});
    expect_near(view.forward(), {0.6, 0, -0.8});
    expect_near(view.right(), {0, -1, 0});
    expect_near(view.up(), {0.8, 0, 0.6});
}

class AnyProjection : public testing::TestWithParam<Projection> {};

TEST_P(AnyProjection, TheMiddleIsTheTarget) {
    const CameraView view(camera(GetParam(), 80, {640, 480}));
    expect_near(view.direction_at(320, 240).value(), {0, 1, 0});
}

TEST_P(AnyProjection, XGoesToTheRightAndYDownwards) {
    const CameraView view(camera(GetParam(), 80, {640, 480}));
    EXPECT_GT(view.direction_at(321, 240)->x, 1e-3);
    EXPECT_GT(view.direction_at(320, 239)->z, 1e-3);
    expect_near(view.direction_at(320, 239).value(),
                {0, view.direction_at(320, 239)->y, -view.direction_at(320, 241)->z});
}

TEST_P(AnyProjection, TheFieldOfViewReachesFromEdgeToEdge) {
    const CameraView view(camera(GetParam(), 80, {640, 480}));
    const double half = 40 * kDegree;
    expect_near(view.direction_at(640, 240).value(), {std::sin(half), std::cos(half), 0});
    expect_near(view.direction_at(0, 240).value(), {-std::sin(half), std::cos(half), 0});
}

TEST_P(AnyProjection, DirectionsAreUnitVectors) {
    const CameraView view(camera(GetParam(), 150, {30, 20}));
    for (int j = 0; j <= 20; ++j) {
        for (int i = 0; i <= 30; ++i) {
            if (const auto direction = view.direction_at(i, j)) {
                EXPECT_NEAR(length(*direction), 1, 1e-14);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(CameraView, AnyProjection,
                         testing::Values(Projection::perspective, Projection::fisheye, Projection::panorama),
                         [](const testing::TestParamInfo<Projection>& tested) {
                             return std::string(name_of(tested.param));
                         });

TEST(Perspective, CornersAreThoseOfThePlane) {
    const CameraView view(camera(Projection::perspective, 90, {400, 200}));
    expect_near(view.direction_at(0, 0).value(), normalized(Vec3{-1, 1, 0.5}));
    expect_near(view.direction_at(400, 200).value(), normalized(Vec3{1, 1, -0.5}));
}

TEST(Perspective, StraightLinesStayStraight) {
    // Places of points on the line (x, 2, 1 + x / 2), in a picture whose pixels are 1/100 at distance 1.
    const CameraView view(camera(Projection::perspective, 90, {200, 200}));
    for (const double x : {-1.5, -0.2, 0.6, 1.9}) {
        const double across = x / 2, upwards = (1 + x / 2) / 2;
        expect_near(view.direction_at(100 + 100 * across, 100 - 100 * upwards).value(),
                    normalized(Vec3{x, 2, 1 + x / 2}));
    }
}

TEST(Perspective, PixelsFillThePyramid) {
    // 4 arcsin(sin(a / 2) sin(b / 2)) for the angles at the apex between opposite faces.
    const double half_width = 50 * kDegree, half_height = std::atan(std::tan(half_width) * 3 / 4);
    EXPECT_NEAR(solid_angle_of_pixels(camera(Projection::perspective, 100, {40, 30})),
                4 * std::asin(std::sin(half_width) * std::sin(half_height)), 1e-12);
}

TEST(Fisheye, IsEquiangularInAllDirections) {
    const CameraView view(camera(Projection::fisheye, 180, {200, 200}));
    for (const double radius : {1.0, 30.0, 77.7, 99.9}) {
        for (const double turn : {0.0, 0.7, 2.0, 3.5, 5.9}) {
            const auto direction =
                view.direction_at(100 + radius * std::cos(turn), 100 - radius * std::sin(turn));
            EXPECT_NEAR(angle_between(direction.value(), view.forward()), radius / 100 * kPi / 2, 1e-12);
            EXPECT_NEAR(std::atan2(direction->z, direction->x), std::remainder(turn, 2 * kPi), 1e-9);
        }
    }
}

TEST(Fisheye, ShowsACircle) {
    const CameraView view(camera(Projection::fisheye, 180, {200, 200}));
    for (const double turn : {0.1, 1.0, 2.2, 4.0}) {
        const double x = std::cos(turn), y = std::sin(turn);
        EXPECT_TRUE(view.direction_at(100 + 99.99 * x, 100 + 99.99 * y).has_value());
        EXPECT_FALSE(view.direction_at(100 + 100.01 * x, 100 + 100.01 * y).has_value());
    }
    EXPECT_FALSE(view.direction_at(0, 0).has_value());
}

TEST(Fisheye, ANarrowPictureCutsTheCircleAboveAndBelow) {
    const CameraView view(camera(Projection::fisheye, 180, {200, 100}));
    EXPECT_NEAR(angle_between(view.direction_at(100, 0).value(), view.forward()), kPi / 4, 1e-12);
}

TEST(Fisheye, SeesAllAroundAt360Degrees) {
    const CameraView view(camera(Projection::fisheye, 360, {200, 200}));
    expect_near(view.direction_at(200, 100).value(), {0, -1, 0});
    expect_near(view.direction_at(150, 100).value(), {1, 0, 0});
    expect_near(view.direction_at(100, 50).value(), {0, 0, 1});
}

TEST(Fisheye, PixelsFillTheCap) {
    // The pixels on the circle's edge are missing: about 1.4 percent of the hemisphere at this size.
    const double hemisphere = 2 * kPi;
    const double sum = solid_angle_of_pixels(camera(Projection::fisheye, 180, {400, 400}));
    EXPECT_LT(sum, hemisphere);
    EXPECT_GT(sum, 0.98 * hemisphere);
}

TEST(Panorama, ColumnsAreAzimuthsAndRowsElevations) {
    const CameraView view(camera(Projection::panorama, 360, {360, 180}));
    expect_near(view.direction_at(270, 90).value(), {1, 0, 0});
    expect_near(view.direction_at(90, 90).value(), {-1, 0, 0});
    expect_near(view.direction_at(0, 90).value(), {0, -1, 0});
    expect_near(view.direction_at(270, 45).value(), normalized(Vec3{1, 0, 1}));
    for (const double x : {0.0, 123.4, 360.0}) {
        expect_near(view.direction_at(x, 0).value(), {0, 0, 1});
        expect_near(view.direction_at(x, 180).value(), {0, 0, -1});
    }
}

TEST(Panorama, PixelsCoverTheSphere) {
    EXPECT_NEAR(solid_angle_of_pixels(camera(Projection::panorama, 360, {72, 36})), 4 * kPi, 1e-9);
}

TEST(Panorama, ShowsNothingBeyondThePoles) {
    const CameraView view(camera(Projection::panorama, 360, {100, 100}));
    EXPECT_TRUE(view.direction_at(50, 25.01).has_value());
    EXPECT_FALSE(view.direction_at(50, 24.99).has_value());
    EXPECT_FALSE(view.direction_at(50, 75.01).has_value());
}

}  // namespace
}  // namespace stilb::sensors
