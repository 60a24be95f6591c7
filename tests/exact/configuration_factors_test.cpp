#include "exact/configuration_factors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "exact/quadrature.h"

namespace stilb::exact {
namespace {

using std::numbers::pi;
using test::integrate;

constexpr int kConfigurations = 150;

class Dice {
  public:
    explicit Dice(unsigned seed) : generator_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator_);
    }
    Vec3 in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    Vec3 direction() {
        std::normal_distribution<double> normal;
        return normalized({normal(generator_), normal(generator_), normal(generator_)});
    }

  private:
    std::mt19937_64 generator_;
};

/// What an emitting element of 1 m2 at `point` contributes at 1 cd/m2.
double contribution(const Receiver& receiver, const Vec3& point, const Vec3& unit_emitter_normal) {
    const Vec3 to_emitter = point - receiver.position;
    const double squared = squared_length(to_emitter);
    const double at_receiver = dot(to_emitter, receiver.normal),
                 at_emitter = -dot(to_emitter, unit_emitter_normal);
    return std::max(0.0, at_receiver) * std::max(0.0, at_emitter) / (squared * squared);
}

/// A triangle by quadrature in (s, t), point = a + s (b - a + t (c - b)), with kinks at the receiver's
/// horizon.
double triangle_by_quadrature(const Receiver& receiver, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 doubled_area = cross(b - a, c - a);
    const Vec3 front = normalized(doubled_area);
    const auto height = [&](const Vec3& point) { return dot(point - receiver.position, receiver.normal); };
    const double at_a = height(a), at_b = height(b), at_c = height(c);
    return integrate(
        [&](double t) {
            const double at_end = at_b + t * (at_c - at_b);
            return integrate(
                [&](double s) {
                    const Vec3 point = a + s * (b - a + t * (c - b));
                    return s * length(doubled_area) * contribution(receiver, point, front);
                },
                0, 1, {at_a / (at_a - at_end)});
        },
        0, 1, {at_b / (at_b - at_c)});
}

/// A disk by quadrature in polar coordinates, with kinks at the receiver's horizon.
double disk_by_quadrature(const Receiver& receiver, const DiskPosition& disk) {
    const Frame frame = Frame::around(disk.normal);
    const double middle = dot(disk.center - receiver.position, receiver.normal);
    const double along_u = dot(frame.u, receiver.normal), along_v = dot(frame.v, receiver.normal);
    const double steepest = std::atan2(along_v, along_u);  // the angle along which height rises fastest
    const double rise = std::hypot(along_u, along_v);
    const double crossing =
        std::acos(-middle / (rise * disk.radius_m));  // NaN where the horizon misses the disk
    return integrate(
        [&](double angle) {
            const Vec3 outward = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
            return integrate(
                [&](double r) { return r * contribution(receiver, disk.center + r * outward, disk.normal); },
                0, disk.radius_m, {-middle / dot(outward, receiver.normal)});
        },
        steepest - pi, steepest + pi, {steepest - crossing, steepest + crossing});
}

/// A sphere by quadrature over the receiver's hemisphere: at each polar angle the arc inside the sphere's
/// cone.
double sphere_by_quadrature(const Receiver& receiver, const Vec3& center, double radius) {
    const Vec3 to_center = center - receiver.position;
    const double half_angle = std::asin(radius / length(to_center));
    const double tilt = std::acos(dot(normalized(to_center), receiver.normal));
    const auto ring = [&](double polar) {
        const double cosine =
            (std::cos(half_angle) - std::cos(polar) * std::cos(tilt)) / (std::sin(polar) * std::sin(tilt));
        return 2 * std::acos(std::clamp(cosine, -1.0, 1.0)) * std::cos(polar) * std::sin(polar);
    };
    const double first = std::abs(tilt - half_angle), last = std::min(tilt + half_angle, pi / 2);
    const double whole_rings = tilt < half_angle ? pi * std::pow(std::sin(first), 2) : 0;
    if (first >= last) return whole_rings;
    // The cosine takes the square roots at both ends away.
    return whole_rings + integrate(
                             [&](double u) {
                                 const double polar = (first + last - (last - first) * std::cos(u)) / 2;
                                 return ring(polar) * (last - first) / 2 * std::sin(u);
                             },
                             0, pi);
}

TEST(PointSource, FollowsTheInverseSquareAndTheCosine) {
    const Receiver floor{{1, 2, 0}, {0, 0, 3}};
    EXPECT_NEAR(illuminance_by_point_lx(floor, {1, 2, 2}, 100), 25, 1e-13);
    EXPECT_NEAR(illuminance_by_point_lx(floor, {4, 2, 4}, 100), 100 * 0.8 / 25, 1e-13);
    EXPECT_EQ(illuminance_by_point_lx(floor, {1, 2, -2}, 100), 0);
}

TEST(Polygon, EqualsQuadratureForRandomTriangles) {
    Dice dice(1);
    int compared = 0, cut_by_horizon = 0;
    for (int i = 0; i < 2 * kConfigurations; ++i) {
        const std::array<Vec3, 3> corners{dice.in_cube(1), dice.in_cube(1), dice.in_cube(1)};
        const Vec3 front = cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (length(front) < 0.2) continue;
        const Vec3 inside = (corners[0] + corners[1] + corners[2]) / 3;
        const Receiver receiver{inside + dice.in_cube(1) + dice.between(0.5, 2) * normalized(front),
                                dice.direction()};
        if (dot(receiver.position - inside, normalized(front)) < 0.3) continue;
        int above = 0;
        for (const Vec3& corner : corners) above += dot(corner - receiver.position, receiver.normal) > 0;
        cut_by_horizon += above == 1 || above == 2;
        ++compared;
        const double expected = triangle_by_quadrature(receiver, corners[0], corners[1], corners[2]);
        EXPECT_NEAR(illuminance_by_polygon_lx(receiver, corners, 7), 7 * expected, 1e-11) << "case " << i;
    }
    EXPECT_GT(compared, 100);
    EXPECT_GT(cut_by_horizon, 20);
}

TEST(Polygon, EqualsQuadratureForRandomRectangles) {
    Dice dice(2);
    for (int i = 0; i < kConfigurations; ++i) {
        const Frame frame = Frame::around(dice.direction());
        const Vec3 corner = dice.in_cube(1);
        const Vec3 edge_u = dice.between(0.2, 2) * frame.u;
        const Vec3 edge_v = dice.between(0.2, 2) * frame.v + dice.between(-0.3, 0.3) * frame.u;
        const Receiver receiver{corner + dice.between(0.3, 2) * frame.w + dice.between(-2, 2) * frame.u +
                                    dice.between(-2, 2) * frame.v,
                                dice.direction()};
        const Vec3 far_corner = corner + edge_u + edge_v;
        const double expected = triangle_by_quadrature(receiver, corner, corner + edge_u, far_corner) +
                                triangle_by_quadrature(receiver, corner, far_corner, corner + edge_v);
        EXPECT_NEAR(illuminance_by_rectangle_lx(receiver, corner, edge_u, edge_v, 1), expected, 1e-10)
            << "case " << i;
    }
}

TEST(Polygon, OfConcaveShapeIsTheSumOfItsTriangles) {
    // An L of six vertices, clipped by the horizon into one or two pieces.
    const std::vector<Vec3> corners{{0, 0, 2}, {0, 2, 2}, {1, 2, 2}, {1, 1, 2}, {2, 1, 2}, {2, 0, 2}};
    const std::array<std::array<std::size_t, 3>, 4> triangles{{{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}};
    Dice dice(3);
    int visible = 0;
    for (int i = 0; i < kConfigurations; ++i) {
        const Receiver receiver{{dice.between(-3, 3), dice.between(-3, 3), dice.between(-1, 1.9)},
                                dice.direction()};
        double sum = 0;
        for (const auto& [a, b, c] : triangles)
            sum += illuminance_by_polygon_lx(receiver, std::array{corners[a], corners[b], corners[c]}, 1);
        const double whole = illuminance_by_polygon_lx(receiver, corners, 1);
        EXPECT_NEAR(whole, sum, 1e-13) << "case " << i;
        visible += whole > 0;
    }
    EXPECT_GT(visible, 50);
}

TEST(Polygon, FarAwayIsAPointSource) {
    const Receiver receiver{{0, 0, 0}, {0.6, 0, 0.8}};
    const Vec3 corner{-0.005, -0.01, 100};
    const double measured = illuminance_by_rectangle_lx(receiver, corner, {0, 0.02, 0}, {0.01, 0, 0}, 5e4);
    const double intensity_cd = 5e4 * 0.01 * 0.02;
    EXPECT_NEAR(measured / (intensity_cd * 0.8 / 1e4), 1, 2e-8);  // the size counts as (0.02 / 100)^2 / 2
}

TEST(Polygon, ShinesToItsFrontOnly) {
    const std::array<Vec3, 3> corners{Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_GT(illuminance_by_polygon_lx({{0.2, 0.2, 1}, {0, 0, -1}}, corners, 1), 0.3);
    EXPECT_EQ(illuminance_by_polygon_lx({{0.2, 0.2, -1}, {0, 0, 1}}, corners, 1), 0);
    EXPECT_EQ(illuminance_by_polygon_lx({{2, 2, 0}, {-1, 0, 0}}, corners, 1), 0);
}

TEST(Polygon, OfHugeSizeFillsTheHemisphere) {
    const double measured =
        illuminance_by_rectangle_lx({{0, 0, 0}, {0, 0, 1}}, {-1e8, -1e8, 1}, {0, 2e8, 0}, {2e8, 0, 0}, 1);
    EXPECT_NEAR(measured, pi, 1e-13);
}

TEST(Disk, OnTheAxisHasItsKnownValue) {
    for (const double radius : {1e-3, 0.1, 1.0, 50.0}) {
        const double measured =
            illuminance_by_disk_lx({{1, 2, 3}, {0, 0, -1}}, {{1, 2, 1}, {0, 0, 2}, radius}, 10);
        const double expected = 10 * pi * radius * radius / (radius * radius + 4);
        EXPECT_NEAR(measured / expected, 1, 1e-13) << radius;
    }
}

TEST(Disk, EqualsQuadratureInRandomPositions) {
    Dice dice(4);
    int cut_by_horizon = 0;
    for (int i = 0; i < kConfigurations; ++i) {
        const DiskPosition disk{dice.in_cube(1), dice.direction(), dice.between(0.1, 1.5)};
        const Frame frame = Frame::around(disk.normal);
        // Every fifth receiver stands nearly on the axis, where the closed form would cancel.
        const double spread = i % 5 == 0 ? 0.01 : 2;
        const Vec3 sideways =
            dice.between(-spread, spread) * frame.u + dice.between(-spread, spread) * frame.v;
        const Receiver receiver{disk.center + sideways + dice.between(0.4, 2) * disk.normal,
                                dice.direction()};
        const double swing = disk.radius_m * length(cross(disk.normal, receiver.normal));
        cut_by_horizon += std::abs(dot(disk.center - receiver.position, receiver.normal)) < swing;
        EXPECT_NEAR(illuminance_by_disk_lx(receiver, disk, 1), disk_by_quadrature(receiver, disk), 1e-10)
            << "case " << i;
    }
    EXPECT_GT(cut_by_horizon, 25);
}

TEST(Disk, EqualsItsInscribedAndCircumscribedPolygonsToSecondOrder) {
    const DiskPosition disk{{0.3, -0.2, 1.5}, {0, 0, -1}, 0.8};
    const Receiver receiver{{1, 0.5, 0}, normalized({-0.4, 0.1, 0.3})};
    const auto polygon_lx = [&](double radius, int corners) {
        std::vector<Vec3> vertices;
        for (int i = 0; i < corners; ++i) {
            const double angle = -2 * pi * i / corners;
            vertices.push_back(disk.center + radius * Vec3{std::cos(angle), std::sin(angle), 0});
        }
        return illuminance_by_polygon_lx(receiver, vertices, 1);
    };
    const double measured = illuminance_by_disk_lx(receiver, disk, 1);
    EXPECT_GT(measured, polygon_lx(disk.radius_m, 1000));
    EXPECT_LT(measured, polygon_lx(disk.radius_m / std::cos(pi / 1000), 1000));
}

TEST(Disk, NearItsRimStaysBetweenNearbyValues) {
    // A hair above the plane, just inside and just outside of the rim: nearly all or nearly half of the sky
    // below.
    const DiskPosition disk{{0, 0, 0}, {0, 0, 1}, 1};
    EXPECT_NEAR(illuminance_by_disk_lx({{0.5, 0, 1e-6}, {0, 0, -1}}, disk, 1), pi, 1e-10);
    EXPECT_NEAR(illuminance_by_disk_lx({{1, 0, 1e-6}, {0, 0, -1}}, disk, 1), pi / 2, 1e-5);
    EXPECT_NEAR(illuminance_by_disk_lx({{1.5, 0, 1e-6}, {0, 0, -1}}, disk, 1), 0, 1e-10);
    // Upright at the rim, looking inwards: a quarter of the sphere is disk.
    EXPECT_NEAR(illuminance_by_disk_lx({{1, 0, 1e-6}, {-1, 0, 0}}, disk, 1), pi / 2, 1e-4);
}

TEST(Disk, IsSmoothInTheTiltAcrossTheHorizon) {
    const DiskPosition disk{{0.5, 0, 2}, {0, 0, -1}, 0.7};
    const auto tilted_lx = [&](double tilt) {
        return illuminance_by_disk_lx({{0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}}, disk, 1);
    };
    // The rim touches the horizon at two tilts; second differences there are of the order of the step
    // squared.
    for (const double touching : {pi / 2 + std::atan2(-0.2, 2), pi / 2 + std::atan2(1.2, 2)}) {
        const double step = 1e-4;
        const double bend = tilted_lx(touching - step) - 2 * tilted_lx(touching) + tilted_lx(touching + step);
        EXPECT_LT(std::abs(bend), 3 * step * step);
    }
    EXPECT_EQ(tilted_lx(pi), 0);
}

TEST(Sphere, WhollyVisibleIsAPointOfTheSameIntensity) {
    const Receiver receiver{{1, 0, 0}, {0, 0.6, 0.8}};
    const double measured = illuminance_by_sphere_lx(receiver, {1, 0, 5}, 2, 30);
    EXPECT_NEAR(measured, 30 * pi * 4 / 25 * 0.8, 1e-12);
    EXPECT_NEAR(measured, illuminance_by_point_lx(receiver, {1, 0, 5}, 30 * pi * 4), 1e-12);
}

TEST(Sphere, CutInHalfHasItsKnownValue) {
    for (const double half_angle : {0.01, 0.3, 1.0, 1.5}) {
        const double measured =
            illuminance_by_sphere_lx({{0, 0, 0}, {0, 0, 1}}, {0, 2, 0}, 2 * std::sin(half_angle), 1);
        EXPECT_NEAR(measured, half_angle - std::sin(half_angle) * std::cos(half_angle), 1e-14);
    }
}

TEST(Sphere, TouchingFillsTheHemisphereAroundItsCenter) {
    // Its cone is a half space: an element tilted by t sees (1 + cos t) / 2 of what an untilted one sees.
    for (const double tilt : {0.2, 1.0, 2.0, 3.0}) {
        const Receiver receiver{{0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}};
        const double measured = illuminance_by_sphere_lx(receiver, {0, 0, 1 + 1e-14}, 1, 1);
        EXPECT_NEAR(measured, pi * (1 + std::cos(tilt)) / 2, 1e-6);
    }
}

TEST(Sphere, EqualsQuadratureInRandomPositions) {
    Dice dice(5);
    int cut_by_horizon = 0;
    for (int i = 0; i < kConfigurations; ++i) {
        const double radius = dice.between(0.05, 1);
        const Vec3 center = dice.in_cube(1);
        const Receiver receiver{center + radius * dice.between(1.01, 4) * dice.direction(), dice.direction()};
        cut_by_horizon += std::abs(dot(center - receiver.position, receiver.normal)) < radius;
        EXPECT_NEAR(illuminance_by_sphere_lx(receiver, center, radius, 1),
                    sphere_by_quadrature(receiver, center, radius), 1e-13)
            << "case " << i;
    }
    EXPECT_GT(cut_by_horizon, 25);
}

TEST(Sphere, EqualsADiskAcrossItsConeInEveryTilt) {
    Dice dice(6);
    const Vec3 center{0, 0, 2};
    for (int i = 0; i < kConfigurations; ++i) {
        const double sine = dice.between(0.05, 0.95);
        const Receiver receiver{{0, 0, 0}, dice.direction()};
        const DiskPosition rim{(1 - sine * sine) * center, {0, 0, -1}, 2 * sine * std::sqrt(1 - sine * sine)};
        EXPECT_NEAR(illuminance_by_sphere_lx(receiver, center, 2 * sine, 1),
                    illuminance_by_disk_lx(receiver, rim, 1), 1e-13)
            << "case " << i;
    }
}

TEST(ConfigurationFactors, RefuseArgumentsOutsideTheirDomain) {
    const Receiver receiver{{0, 0, 0}, {0, 0, 1}};
    const std::array<Vec3, 4> bent{Vec3{0, 0, 1}, {1, 0, 1}, {1, 1, 1.1}, {0, 1, 1}};
    const std::array<Vec3, 3> line{Vec3{0, 0, 1}, {1, 0, 1}, {2, 0, 1}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(illuminance_by_polygon_lx(receiver, bent, 1), std::domain_error);
    EXPECT_THROW(illuminance_by_polygon_lx(receiver, line, 1), std::domain_error);
    EXPECT_THROW(illuminance_by_polygon_lx(receiver, std::span(line).first(2), 1), std::domain_error);
    EXPECT_THROW(illuminance_by_polygon_lx({{0, 0, 0}, {0, 0, 0}}, line, 1), std::domain_error);
    EXPECT_THROW(illuminance_by_point_lx(receiver, {0, 0, 0}, 1), std::domain_error);
    EXPECT_THROW(illuminance_by_point_lx(receiver, {0, 0, 1}, -1), std::domain_error);
    EXPECT_THROW(illuminance_by_point_lx({{nan, 0, 0}, {0, 0, 1}}, {0, 0, 1}, 1), std::domain_error);
    EXPECT_THROW(illuminance_by_disk_lx(receiver, {{0, 0, 1}, {0, 0, -1}, 0}, 1), std::domain_error);
    EXPECT_THROW(illuminance_by_disk_lx(receiver, {{0, 0, 1}, {0, 0, 0}, 1}, 1), std::domain_error);
    EXPECT_THROW(illuminance_by_disk_lx(receiver, {{0, 0, 1}, {0, 0, -1}, 1}, nan), std::domain_error);
    EXPECT_THROW(illuminance_by_sphere_lx(receiver, {0, 0, 1}, 1, 1), std::domain_error);
    EXPECT_THROW(illuminance_by_sphere_lx(receiver, {0, 0, 1}, -0.5, 1), std::domain_error);
}

}  // namespace
}  // namespace stilb::exact
