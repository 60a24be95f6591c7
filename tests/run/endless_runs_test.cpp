// Runs that would have no end.
#include <gtest/gtest.h>

#include "run/run.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

Scene closed_room(double reflectance) {
    Scene scene;
    add_area_light(scene, inward(Box{{0, 0, 0}, {2, 2, 2}}), Rgb::grey(100), diffuse(reflectance));
    return scene;
}

/// A point in the edge of wall and floor: it reads what points beside it do, or 0 with a warning.
TEST(EndlessRuns, ASensorOnAnEdgeEndsARun) {
    const Grid floor{.corner = {0, 0, 0}, .edge_u = {2, 0, 0}, .edge_v = {0, 2, 0}, .count = {10, 10}};
    const std::vector<Sensor> sensors{Sensor{"edge", IlluminancePoints{{{{0, 1, 0}, {0, 0, 1}}}}},
                                      Sensor{"grid", floor}};
    RunOptions options;
    options.error = 0.02;
    options.time_s = 120;
    const RunResult result = measure(closed_room(0.5), sensors, options);
    EXPECT_EQ(result.stop_reason, StopReason::target_reached);
    const statistics::Estimate& edge = result.sensors[0].readings[0].estimate;
    constexpr double inside_lx = 2 * kPi * 100;
    if (edge.value == 0) {
        EXPECT_FALSE(result.warnings.empty());
    } else {
        EXPECT_NEAR(edge.value, inside_lx, 3 * half_width(edge));
    }
}

TEST(EndlessRuns, AWhiteRoomIsRefused) {
    const Sensor desk{"desk", IlluminancePoints{{{{1, 1, 0.8}, {0, 0, 1}}}}};
    RunOptions options;
    options.paths = 256;
    for (const char* method : {"auto", "path", "local", "ray-bundle", "radiosity", "particles"}) {
        options.method = method;
        EXPECT_THROW(measure(closed_room(1), {&desk, 1}, options), InputError) << method;
    }
    options.method = "path";
    options.bounces = 3;  // L + 3 reflections of it
    const auto result = measure(closed_room(1), {&desk, 1}, options);
    const statistics::Estimate& reading = result.sensors[0].readings[0].estimate;
    EXPECT_NEAR(reading.value, 4 * kPi * 100, 3 * half_width(reading) + 1e-6 * reading.value);
}

}  // namespace
}  // namespace stilb::run
