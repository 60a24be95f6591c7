// A small lamp in the very middle of a scene, where coordinates are finest, seen from afar, where they are
// not.
#include <gtest/gtest.h>

#include "estimators/estimator_list.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kWidth_m = 0.5, kDepth_m = 0.3, kLampLuminance_cd_m2 = 20'000;

/// Facing the lamp, below it, at angles that are no round numbers.
std::vector<MeasuringPoint> points_around(double distance_m, const Frame& lamp) {
    std::vector<MeasuringPoint> points;
    for (int i = 0; i < 32; ++i) {
        const double angle = 2.4 * i, down = 0.1 + 0.85 * i / 31, across = std::sqrt(1 - down * down);
        const Vec3 from_lamp = lamp.to_world({across * std::cos(angle), across * std::sin(angle), -down});
        points.push_back({distance_m * from_lamp, -from_lamp});
    }
    return points;
}

/// By each method. The lamp is as a point: its size changes the light by less than 0.03 %.
void expect_light_of_lamp(const Scene& scene, const std::vector<MeasuringPoint>& points, const Frame& lamp) {
    const Sensor sensor = point_sensor(points);
    for (const auto& entry : estimators::estimator_list()) {
        RunOptions options;
        options.method = entry.name;
        options.paths = 16;
        options.patch_m = 4;
        const RunResult result = measure(scene, {&sensor, 1}, options);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double distance_m = length(points[i].position);
            const double as_point_lx = kLampLuminance_cd_m2 * kWidth_m * kDepth_m *
                                       lamp.to_local(points[i].normal).z / (distance_m * distance_m);
            const statistics::Estimate& found = result.sensors[0].readings[i].estimate;
            EXPECT_NEAR(found.value, as_point_lx, 0.0003 * as_point_lx + 5 * found.standard_error)
                << entry.name << " at " << distance_m << " m, point " << i;
        }
    }
}

/// That shines against the direction w.
void add_lamp(Scene& scene, const Frame& lamp) {
    add_area_light(
        scene,
        Rectangle{lamp.to_world({-kWidth_m / 2, -kDepth_m / 2, 0}), kDepth_m * lamp.v, kWidth_m * lamp.u},
        Rgb::grey(kLampLuminance_cd_m2));
}

TEST(LampInMiddle, LightsPointsFarAway) {
    const Frame lamp{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Scene scene;
    // Its size is that of the scene, which has its middle in the lamp.
    add_object(scene, Sphere{{0, 0, 0}, 30}, diffuse(0));
    add_lamp(scene, lamp);
    for (const double distance_m : {19.4164, 29.0})
        expect_light_of_lamp(scene, points_around(distance_m, lamp), lamp);
}

/// So that the lamp is not lifted for those who see it from afar alone.
TEST(LampInMiddle, LightsPointsFarAwayBesideOneNearby) {
    for (const Vec3& up : {Vec3{0.1, 0.2, 1}, Vec3{-1, 0.7, 0.3}, Vec3{0.3, -1, -0.5}}) {
        const Frame lamp = Frame::around(normalized(up));
        Scene scene;
        add_lamp(scene, lamp);
        for (const double distance_m : {97.3, 611.7, 5432.1}) {
            std::vector<MeasuringPoint> points = points_around(distance_m, lamp);
            points.push_back({-20 * lamp.w, lamp.w});
            expect_light_of_lamp(scene, points, lamp);
        }
    }
}

}  // namespace
}  // namespace stilb::run
