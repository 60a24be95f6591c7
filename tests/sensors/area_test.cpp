#include "sensors/areas/area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stilb::sensors {
namespace {

Area settled(Area area) {
    const auto fault = area.settle(GivenKeys({"corners"}));
    EXPECT_FALSE(fault) << fault->message;
    return area;
}

std::string fault_of_area(Area area) {
    const auto fault = area.settle(GivenKeys({"corners", "spacing"}));
    return fault ? std::string(fault->key) + ": " + fault->message : "";
}

std::vector<Vec3> rectangle(double x_m, double y_m, double z_m = 0.75) {
    return {{0, 0, z_m}, {x_m, 0, z_m}, {x_m, y_m, z_m}, {0, y_m, z_m}};
}

/// EN 12464-1 gives these typical distances, rounded, for the length of an area.
TEST(Area, SpacingIsThatOfTheStandard) {
    for (const auto& [length_m, spacing_m] :
         {std::pair{1., 0.2}, {2., 0.3}, {5., 0.6}, {10., 1.}, {25., 2.}, {50., 3.}, {100., 5.}}) {
        EXPECT_NEAR(raster_spacing_m(0.8 * length_m, length_m), spacing_m, 0.1 * spacing_m) << length_m;
    }
    EXPECT_DOUBLE_EQ(raster_spacing_m(10, 10), 1);
    EXPECT_DOUBLE_EQ(raster_spacing_m(1, 1), 0.2);
    EXPECT_DOUBLE_EQ(raster_spacing_m(1000, 1000), 10) << "at most 10 m";
    // From twice as long on, the shorter side counts.
    EXPECT_DOUBLE_EQ(raster_spacing_m(5, 9.99), 0.2 * std::pow(5, std::log10(9.99)));
    EXPECT_DOUBLE_EQ(raster_spacing_m(5, 10), 0.2 * std::pow(5, std::log10(5)));
}

TEST(Area, RasterHasNearlySquareCells) {
    // d = 1.6, p = 0.278: 6 points of 0.267 m; the other side has 3 of them.
    const Area desk = settled({.polygon = {rectangle(1.6, 0.8001), {}}});
    ASSERT_EQ(desk.size(), 18U);
    EXPECT_NEAR(desk.cell_m[0], 1.6 / 6, 1e-12);
    EXPECT_NEAR(desk.cell_m[1], 0.8001 / 3, 1e-12);
    EXPECT_NEAR(length(desk.points.front().position - Vec3{1.6 / 12, 0.8001 / 6, 0.75}), 0, 1e-12);
    EXPECT_EQ(desk.points.front().normal, (Vec3{0, 0, 1}));
    // Twice as long: d = 0.8, p = 0.171: 5 points of 0.16 m, and 10.
    EXPECT_EQ(settled({.polygon = {rectangle(1.6, 0.8), {}}}).size(), 50U);
    // Classroom of 7.2 m x 6 m: p = 0.795; 9 x 8 points.
    EXPECT_EQ(settled({.polygon = {rectangle(7.2, 6), {}}}).size(), 72U);
    EXPECT_EQ(settled({.polygon = {rectangle(4, 3), {}}, .spacing_m = 0.5}).size(), 48U);
}

TEST(Area, PolygonsHavePointsInsideOnly) {
    const Area area =
        settled({.polygon = {{{0, 0, 1}, {4, 0, 1}, {4, 1, 1}, {1, 1, 1}, {1, 4, 1}, {0, 4, 1}}, {}},
                 .spacing_m = 0.5});
    EXPECT_EQ(area.size(), 28U);  // 7 m2
    for (const MeasuringPoint& point : area.points) EXPECT_TRUE(point.position.x < 1 || point.position.y < 1);
    const Area holed =
        settled({.polygon = {rectangle(4, 4), {{{1, 1, 0.75}, {3, 1, 0.75}, {3, 3, 0.75}, {1, 3, 0.75}}}},
                 .spacing_m = 0.5});
    EXPECT_EQ(holed.size(), 48U);
}

/// In any position the points are those of the flat area, on the side of its corners' sense.
TEST(Area, MayStandAnywhere) {
    const Frame frame = Frame::around(normalized(Vec3{0.3, -0.5, 0.4}));
    const Vec3 origin{10, 20, 30};
    Area tilted{.polygon = {rectangle(4, 3, 0), {}}};
    for (Vec3& corner : tilted.polygon.outline) corner = origin + frame.to_world(corner);
    tilted = settled(tilted);
    const Area flat = settled({.polygon = {rectangle(4, 3, 0), {}}});
    ASSERT_EQ(tilted.size(), flat.size());
    for (std::size_t j = 0; j < flat.size(); ++j) {
        EXPECT_NEAR(length(tilted.points[j].position - origin - frame.to_world(flat.points[j].position)), 0,
                    1e-9);
        EXPECT_NEAR(length(tilted.points[j].normal - frame.w), 0, 1e-12);
    }
    std::ranges::reverse(tilted.polygon.outline);
    tilted.points.clear();
    EXPECT_NEAR(length(settled(tilted).points[0].normal + frame.w), 0, 1e-12);
}

TEST(Area, HorizontalOnesLookUp) {
    std::vector<Vec3> corners = rectangle(4, 3);
    std::ranges::reverse(corners);
    EXPECT_EQ(settled({.polygon = {corners, {}}}).points[0].normal, (Vec3{0, 0, 1}));
    EXPECT_EQ(settled({.polygon = {corners, {}}, .normal = Vec3{0, 1, 0}}).points[0].normal, (Vec3{0, 1, 0}));
}

TEST(Area, BandsSurroundIt) {
    const std::vector<Vec3> corners = rectangle(4, 3);
    const Area band = settled({.polygon = {corners, {}}, .spacing_m = 0.05, .band_m = {0, 0.5}});
    // Sides, and quarters of circles at the corners.
    const double area_m2 = 2 * 7 * 0.5 + M_PI * 0.25, cell_m2 = band.cell_m[0] * band.cell_m[1];
    EXPECT_NEAR(static_cast<double>(band.size()) * cell_m2, area_m2, 0.02 * area_m2);
    for (const MeasuringPoint& point : band.points) {
        const double dx = std::max({-point.position.x, point.position.x - 4, 0.0});
        const double dy = std::max({-point.position.y, point.position.y - 3, 0.0});
        EXPECT_GT(std::hypot(dx, dy), 0);
        EXPECT_LE(std::hypot(dx, dy), 0.5);
        EXPECT_EQ(point.position.z, 0.75);
    }
    const Area further = settled({.polygon = {corners, {}}, .spacing_m = 0.05, .band_m = {0.5, 1.5}});
    const double further_m2 = 2 * 7 + M_PI * (1.5 * 1.5 - 0.25);
    EXPECT_NEAR(static_cast<double>(further.size()) * further.cell_m[0] * further.cell_m[1], further_m2,
                0.02 * further_m2);
    // By default four points across: p(0.5) = 0.123.
    const Area usual = settled({.polygon = {corners, {}}, .band_m = {0, 0.5}});
    EXPECT_NEAR(usual.cell_m[0], 0.125, 0.002);
    EXPECT_NEAR(usual.cell_m[1], 0.125, 0.002);
}

TEST(Area, RefusesWhatIsNoArea) {
    EXPECT_EQ(fault_of_area({.polygon = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}}}),
              "corners: the area has no extent. Allowed: corners that are not on one line.");
    EXPECT_EQ(fault_of_area({.polygon = {{}, {}}}),
              "corners: the area has no extent. Allowed: corners that are not on one line.");
    std::vector<Vec3> bent = rectangle(4, 3, 0);
    bent.push_back({-1, 1.5, 0.1});
    EXPECT_TRUE(fault_of_area({.polygon = {bent, {}}}).ends_with("Allowed: corners in one plane."));
    EXPECT_EQ(
        fault_of_area({.polygon = {rectangle(4, 3), {{{1, 1, 1}, {2, 1, 1}, {2, 2, 1}}}}}),
        "holes: corner 0, counted from 0, is 0.25 m off the plane of the outline. Allowed: corners in one "
        "plane.");
    EXPECT_EQ(
        fault_of_area({.polygon = {rectangle(4, 3), {{{1, 1, 0.75}, {5, 1, 0.75}, {2, 2, 0.75}}}}}),
        "holes: hole 0, counted from 0, is not inside the outline. Allowed: a hole that touches no edge.");
    EXPECT_EQ(fault_of_area({.polygon = {rectangle(4, 3), {}}, .spacing_m = 1e-3}),
              "spacing: asks for a raster of 4000 x 3000 points. Allowed: 10000000 readings in all sensors "
              "together.");
    const std::vector<Vec3> ring{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    EXPECT_EQ(
        fault_of_area({.polygon = {ring, {{{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}}}}, .spacing_m = 4}),
        "spacing: no point of the raster of 4 m x 4 m lies in the area. Allowed: a smaller spacing.");
}

}  // namespace
}  // namespace stilb::sensors
