#include "report/measured_plane.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stilb::report {
namespace {

using sensors::GivenKeys;

/// The readings have the values of a function of the position.
template <typename Value>
SensorResult measured(Sensor sensor, const Value& value_at) {
    SensorResult result;
    for (std::size_t j = 0; j < sensor.size(); ++j) {
        const double value = value_at(position_of(sensor.measurand(j)));
        result.readings.push_back({{value, 0, value, value}, {}});
    }
    result.sensor = std::move(sensor);
    return result;
}

MeasuredPlane plane_of(const SensorResult& result) {
    auto planes = measured_planes({&result, 1});
    EXPECT_EQ(planes.size(), 1u);
    return planes.front();
}

double value(const Vec3& p) { return 100 * p.x + 10 * p.y + p.z; }

/// Each cell has the value of the position that the plane gives it.
void expect_values_in_place(const MeasuredPlane& plane) {
    for (int row = 0; row < plane.panel.nv; ++row) {
        for (int column = 0; column < plane.panel.nu; ++column) {
            const double shown = plane.panel.value_at(column, row);
            if (std::isnan(shown)) continue;
            EXPECT_NEAR(shown, value(plane.at(column + 0.5, row + 0.5)), 1e-9);
        }
    }
}

TEST(MeasuredPlane, HorizontalGridsLieAsOnAPlan) {
    const Vec3 x{3, 0, 0}, y{0, 2, 0};
    for (const Grid& grid : {Grid{{1, 1, 0.75}, x, y, {6, 4}}, Grid{{4, 1, 0.75}, y, -x, {4, 6}},
                             Grid{{4, 3, 0.75}, -x, -y, {6, 4}}, Grid{{1, 3, 0.75}, -y, x, {4, 6}},
                             Grid{{1, 1, 0.75}, y, x, {4, 6}}}) {
        const SensorResult result = measured({"desk", grid}, value);
        const MeasuredPlane plane = plane_of(result);
        EXPECT_TRUE(plane.is_horizontal());
        EXPECT_LT(length(plane.corner - Vec3{1, 1, 0.75}), 1e-12);
        EXPECT_LT(length(plane.right - x) + length(plane.up - y), 1e-12);
        EXPECT_EQ(plane.panel.nu, 6);
        EXPECT_EQ(plane.panel.nv, 4);
        expect_values_in_place(plane);
    }
}

TEST(MeasuredPlane, WallsAreSeenFromTheirLitSide) {
    // A board on the wall y = 0 that faces the room: from there, x runs to the left.
    const SensorResult result = measured({"board", Grid{{1, 0, 1}, {0, 0, 1.2}, {4, 0, 0}, {6, 16}}}, value);
    const MeasuredPlane plane = plane_of(result);
    EXPECT_FALSE(plane.is_horizontal());
    EXPECT_LT(length(plane.corner - Vec3{5, 0, 1}), 1e-12);
    EXPECT_LT(length(plane.right - Vec3{-4, 0, 0}) + length(plane.up - Vec3{0, 0, 1.2}), 1e-12);
    EXPECT_EQ(plane.panel.nu, 16);
    EXPECT_NEAR(plane.panel.width_m, 4, 1e-12);
    expect_values_in_place(plane);
    EXPECT_NEAR(plane.to_plane({3, 0, 1.6})[0], 2, 1e-12);
    EXPECT_NEAR(plane.to_plane({3, 0, 1.6})[1], 0.6, 1e-12);
}

TEST(MeasuredPlane, AreasHaveHoles) {
    Area area{{{{3, 1, 0.8}, {3, 5, 0.8}, {1, 5, 0.8}, {1, 1, 0.8}},
               {{{1.9, 2.9, 0.8}, {2.6, 2.9, 0.8}, {2.6, 3.6, 0.8}, {1.9, 3.6, 0.8}}}}};
    area.spacing_m = 0.5;
    ASSERT_FALSE(area.settle(GivenKeys({})));
    const std::size_t with_hole = area.points.size();
    area.points.erase(area.points.begin() + 3);  // as a hidden one
    const SensorResult result = measured({"task", area}, value);
    const MeasuredPlane plane = plane_of(result);
    EXPECT_LT(length(plane.corner - Vec3{1, 1, 0.8}), 1e-9);
    EXPECT_EQ(plane.panel.nu, 4);
    EXPECT_EQ(plane.panel.nv, 8);
    std::size_t shown = 0;
    for (const double cell : plane.panel.values) shown += !std::isnan(cell);
    EXPECT_EQ(shown, with_hole - 1);
    EXPECT_LT(with_hole, 32u);
    expect_values_in_place(plane);
    EXPECT_EQ(outlines_of(result.sensor).size(), 2u);
    EXPECT_TRUE(plane.is_whole());
}

TEST(MeasuredPlane, OneScaleHoldsAllValues) {
    const SensorResult low = measured({"a", Grid{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2}}}, value),
                       high = measured({"b", Grid{{7, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2}}}, value);
    const std::vector<SensorResult> results{low, high};
    const plot::Scale scale = common_scale(measured_planes(results));
    EXPECT_LE(scale.range().low, value({0.25, 0.25, 0}));
    EXPECT_GE(scale.range().high, value({7.75, 0.75, 0}));
    EXPECT_TRUE(measured_planes(std::vector<SensorResult>{}).empty());
}

}  // namespace
}  // namespace stilb::report
