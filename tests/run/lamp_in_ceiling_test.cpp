// A panel in the very plane of the ceiling is the same lamp for every method.
#include <gtest/gtest.h>

#include "estimators/estimator_list.h"
#include "run/run.h"
#include "scene/overlaps.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kHeight_m = 2.8, kLuminance_cd_m2 = 1000;

/// A room with a panel so far below its ceiling, in front of which it is put if that is nothing.
Scene room_with_panel(double below_m) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, kHeight_m}}, diffuse(0.5));
    add_area_light(scene, Rectangle{{1.7, 1.2, kHeight_m - below_m}, {0, 0.6, 0}, {0.6, 0, 0}},
                   Rgb::grey(kLuminance_cd_m2));
    scene::put_lamps_in_front(scene);
    return scene;
}

std::vector<statistics::Estimate> readings_below_ceiling(const Scene& scene, const Sensor& sensor,
                                                         std::string_view method) {
    RunOptions options;
    options.method = method;
    options.paths = 256;
    options.patch_m = 1.2;
    std::vector<statistics::Estimate> readings;
    const RunResult result = measure(scene, {&sensor, 1}, options);
    for (const Reading& reading : result.sensors[0].readings) readings.push_back(reading.estimate);
    return readings;
}

TEST(LampInCeiling, IsAsBrightAsItShouldBe) {
    const Sensor sight{"sight", Luminance{{LineOfSight{{1, 1, 1}, normalized({0.9, 0.4, 1.8})}}}};
    for (const std::string_view method : estimators::luminance_methods()) {
        EXPECT_NEAR(readings_below_ceiling(room_with_panel(0), sight, method)[0].value, kLuminance_cd_m2,
                    1e-3)
            << method;
    }
}

TEST(LampInCeiling, LightsTheRoomAsOneBelowIt) {
    const Sensor sensor = point_sensor({{{2, 1, 0.75}, {0, 0, 1}}, {{0.2, 0.2, 0}, {0, 0, 1}}});
    for (const auto& entry : estimators::estimator_list()) {
        const auto flush = readings_below_ceiling(room_with_panel(0), sensor, entry.name),
                   below = readings_below_ceiling(room_with_panel(1e-4), sensor, entry.name);
        for (std::size_t i = 0; i < 2; ++i) {
            const double error = std::hypot(flush[i].standard_error, below[i].standard_error);
            EXPECT_NEAR(flush[i].value, below[i].value, 4 * error + 0.003 * below[i].value) << entry.name;
        }
    }
}

}  // namespace
}  // namespace stilb::run
