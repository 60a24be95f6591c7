// A small lamp in the very middle of a scene, where coordinates are finest, seen from afar, where they are
// not.
#include <gtest/gtest.h>

#include "estimators/estimator_list.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kWidth_m = 0.5, kDepth_m = 0.3, kLuminance_cd_m2 = 20'000;

/// Facing the lamp, below it, at angles that are no round numbers.
std::vector<MeasuringPoint> points_around(double distance_m) {
    std::vector<MeasuringPoint> points;
    for (int i = 0; i < 32; ++i) {
        const double angle = 2.4 * i, down = 0.1 + 0.85 * i / 31, across = std::sqrt(1 - down * down);
        const Vec3 from_lamp{across * std::cos(angle), across * std::sin(angle), -down};
        points.push_back({distance_m * from_lamp, -from_lamp});
    }
    return points;
}

TEST(LampInMiddle, LightsPointsFarAway) {
    Scene scene;
    // Its size is that of the scene, which has its middle in the lamp.
    add_object(scene, Sphere{{0, 0, 0}, 30}, diffuse(0));
    add_area_light(scene, Rectangle{{-kWidth_m / 2, -kDepth_m / 2, 0}, {0, kDepth_m, 0}, {kWidth_m, 0, 0}},
                   Rgb::grey(kLuminance_cd_m2));
    for (const double distance_m : {19.4164, 29.0}) {
        const auto points = points_around(distance_m);
        const Sensor sensor = point_sensor(points);
        for (const auto& entry : estimators::estimator_list()) {
            RunOptions options;
            options.method = entry.name;
            options.paths = 16;
            options.patches.patch_m = 4;
            const RunResult result = measure(scene, {&sensor, 1}, options);
            for (std::size_t i = 0; i < points.size(); ++i) {
                // As a point: the lamp's size changes it by less than 0.03 %.
                const double as_point_lx =
                    kLuminance_cd_m2 * kWidth_m * kDepth_m * points[i].normal.z / (distance_m * distance_m);
                const statistics::Estimate& found = result.sensors[0].readings[i].estimate;
                EXPECT_NEAR(found.value, as_point_lx, 0.0003 * as_point_lx + 5 * found.standard_error)
                    << entry.name << " at " << distance_m << " m, point " << i;
            }
        }
    }
}

}  // namespace
}  // namespace stilb::run
