// A result names what has computed it: the same scene, seed, technique and number of paths give its bits
// again, whatever ended the run.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "materials/phong.h"
#include "run/run.h"
#include "support/continued_runs.h"

namespace stilb::run {
namespace {

/// Point lights, whose light paths have little noise.
Scene room_with_point_lights() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4.2, 3.1, 2.6}}, diffuse(0.75));
    add_object(scene, Box{{0, 2.4, 0}, {4.2, 3.1, 0.7}}, Phong{Rgb::grey(0.35), Rgb::grey(0.3), 60});
    for (const double x : {1., 3.2})
        for (const double y : {0.8, 2.3}) add_point_light(scene, {x, y, 2.2}, Rgb::grey(100));
    return scene;
}

Sensor grid(int columns, int rows) {
    return {"grid", Grid{{0.5, 0.5, 0.8}, {2, 0, 0}, {0, 2, 0}, {columns, rows}, Vec3{0, 0, 1}}};
}

std::vector<double> values(const RunResult& result) {
    std::vector<double> all;
    for (const SensorResult& sensor : result.sensors) {
        for (const Reading& reading : sensor.readings) {
            all.push_back(reading.estimate.value);
            all.push_back(reading.estimate.standard_error);
        }
    }
    return all;
}

RunOptions given_back(const RunSummary& run, RunOptions options) {
    options.method = run.technique;
    options.paths = run.samples;
    options.error.reset();
    options.time_s.reset();
    return options;
}

void expect_same_again(const Scene& scene, const Sensor& sensor, const RunOptions& options,
                       const std::string& technique) {
    const RunResult first = measure(scene, {&sensor, 1}, options);
    EXPECT_EQ(first.technique, technique);
    const RunResult again = measure(scene, {&sensor, 1}, given_back(first, options));
    EXPECT_EQ(again.method, technique);
    EXPECT_EQ(again.technique, technique);
    EXPECT_EQ(again.samples, first.samples);
    EXPECT_EQ(values(again), values(first)) << technique;
}

RunOptions to_error(double error, std::uint64_t seed = 3) {
    RunOptions options;
    options.error = error;
    options.seed = seed;
    return options;
}

TEST(Technique, GivesTheBitsOfARunThatItsErrorEnded) {
    expect_same_again(room_with_box(), grid(4, 4), to_error(0.02), "path");
    expect_same_again(room_with_point_lights(), grid(5, 5), to_error(0.01), "light-paths");
    expect_same_again(room_with_point_lights(), grid(16, 8), to_error(0.02), "light-paths");
    expect_same_again(room_with_box(), grid(40, 40), to_error(0.01), "guided");
}

TEST(Technique, GivesTheBitsOfARunThatItsRequirementsEnded) {
    Sensor sensor = grid(8, 8);
    sensor.requirements = {{sensors::kCriteria.data(), 10}};
    RunOptions options;
    options.time_s = 3600;
    const RunResult first = measure(room_with_box(), {&sensor, 1}, options);
    ASSERT_EQ(first.stop_reason, StopReason::requirements_decided);
    const RunResult again = measure(room_with_box(), {&sensor, 1}, given_back(first, options));
    EXPECT_EQ(again.samples, first.samples);
    for (std::size_t j = 0; j < first.sensors[0].readings.size(); ++j)
        EXPECT_EQ(again.sensors[0].readings[j].estimate.value, first.sensors[0].readings[j].estimate.value);
}

TEST(Technique, OfOtherMethodsIsTheMethod) {
    const Sensor sensor = grid(2, 2);
    for (const char* method :
         {"local", "double-local", "path", "light-paths", "ray-bundle", "radiosity", "particles"}) {
        RunOptions options;
        options.method = method;
        options.paths = 1;
        options.patch_m = 1;
        EXPECT_EQ(measure(room_with_box(), {&sensor, 1}, options).technique, method);
    }
}

/// Where reflections have a limit there is no guess.
TEST(Technique, NamesWhatIsDoneInsteadOfAGuess) {
    const Sensor sensor = grid(2, 2);
    RunOptions options;
    options.method = "guided";
    options.paths = 64;
    EXPECT_EQ(measure(room_with_box(), {&sensor, 1}, options).technique, "guided");
    options.bounces = 2;
    EXPECT_EQ(measure(room_with_box(), {&sensor, 1}, options).technique, "light-paths");
}

TEST(Technique, GivesTheBitsOfPictures) {
    Camera camera;
    camera.position = {1.5, 0.3, 1.5};
    camera.target = {1.5, 3, 1};
    camera.fov_deg = 90;
    camera.resolution = {48, 32};
    const Sensor sensor{"view", camera};
    for (const Scene& scene : {room_with_box(), room_with_point_lights()}) {
        const RunOptions options = to_error(0.15);
        const RenderResult first = render(scene, sensor, options);
        EXPECT_EQ(first.stop_reason, StopReason::target_reached);
        const RenderResult again = render(scene, sensor, given_back(first, options));
        EXPECT_EQ(again.technique, first.technique);
        EXPECT_EQ(again.samples, first.samples);
        EXPECT_EQ(again.pixels.rgb_cd_m2, first.pixels.rgb_cd_m2);
        EXPECT_EQ(again.pixels.standard_error_cd_m2, first.pixels.standard_error_cd_m2);
    }
}

}  // namespace
}  // namespace stilb::run
