// What a run tells of its sensors beside the estimates.
#include <gtest/gtest.h>

#include "estimators/estimator_list.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/rough_conductor.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// A room of 4 m with a mirror on half of the wall x = 4, and a window, the wall y = 4 being left out.
Scene room_with_mirror() {
    Scene scene;
    for (const auto& [corner, u, v] : {std::array<Vec3, 3>{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}},
                                       std::array<Vec3, 3>{Vec3{0, 0, 3}, Vec3{0, 4, 0}, Vec3{4, 0, 0}},
                                       std::array<Vec3, 3>{Vec3{0, 0, 0}, Vec3{0, 4, 0}, Vec3{0, 0, 3}},
                                       std::array<Vec3, 3>{Vec3{0, 0, 0}, Vec3{0, 0, 3}, Vec3{4, 0, 0}}}) {
        add_object(scene, Rectangle{corner, u, v}, diffuse(0.5));
    }
    add_object(scene, Rectangle{{4, 0, 0}, {0, 0, 3}, {0, 4, 0}}, Mirror{Rgb::grey(0.9)});
    add_area_light(scene, Rectangle{{1, 1, 2.9}, {0, 1, 0}, {1, 0, 0}}, Rgb::grey(1000));
    return scene;
}

/// At the wall x = 0, at the mirror (and from it back to that wall), and out of the window.
Sensor sights() {
    return {"sights",
            Luminance{{LineOfSight{{2, 2, 1}, {-1, 0, 0}}, LineOfSight{{2, 2, 1}, normalized({1, -0.25, 0})},
                       LineOfSight{{2, 2, 1}, {0, 1, 0}}}}};
}

RunOptions measure_options(std::string_view method) {
    RunOptions options;
    options.method = method;
    options.paths = 4096;
    options.patch_m = 1;
    return options;
}

void expect_near(const std::optional<Vec3>& found, const Vec3& expected) {
    ASSERT_TRUE(found);
    EXPECT_NEAR(length(*found - expected), 0, 1e-5);
}

TEST(Measure, TellsWhereLinesOfSightEnd) {
    const Sensor sensor = sights();
    for (const char* method : {"auto", "double-local", "path", "ray-bundle"}) {
        const RunResult result = measure(room_with_mirror(), {&sensor, 1}, measure_options(method));
        const auto& ends = result.sensors[0].sub_points;
        ASSERT_EQ(ends.size(), 3U) << method;
        expect_near(ends[0], {0, 2, 1});
        expect_near(ends[1], {0, 0.5, 1});  // 0.5 m to the mirror's 1.5 m, and another 1 m back
        EXPECT_FALSE(ends[2]) << method;
    }
}

TEST(Measure, LinesOfSightEndAtMirrorsThatTheLimitLeavesOut) {
    const Sensor sensor = sights();
    for (const char* method : {"auto", "double-local", "path"}) {
        RunOptions options = measure_options(method);
        options.bounces = 0;
        const RunResult result = measure(room_with_mirror(), {&sensor, 1}, options);
        expect_near(result.sensors[0].sub_points[1], {4, 1.5, 1});
    }
}

TEST(Measure, ResultsOwnTheirSensorsAndTheMeansOfTheirReplicates) {
    RunOptions options = measure_options("auto");
    RunResult result;
    {
        const std::vector<Sensor> sensors{{"plane", Grid{{0.5, 0.5, 0.8}, {3, 0, 0}, {0, 3, 0}, {3, 2}}},
                                          sights()};
        result = measure(room_with_mirror(), sensors, options);
    }
    ASSERT_EQ(result.sensors.size(), 2U);
    EXPECT_EQ(result.sensors[0].sensor.name, "plane");
    EXPECT_EQ(result.sensors[1].sensor.size(), 3U);
    EXPECT_EQ(result.samples, 4096U);
    for (const SensorResult& sensor : result.sensors) {
        const std::size_t readings = sensor.readings.size();
        ASSERT_EQ(sensor.replicate_means.size(), 32 * readings);
        const auto estimates = statistics::estimate_readings({sensor.replicate_means, readings}, 0.95);
        for (std::size_t j = 0; j < readings; ++j) {
            EXPECT_EQ(estimates[j].value, sensor.readings[j].estimate.value);
            EXPECT_EQ(estimates[j].standard_error, sensor.readings[j].estimate.standard_error);
            EXPECT_NEAR(estimates[j].value, sensor.readings[j].rgb.luminance(),
                        1e-9 * estimates[j].value + 1e-12);
        }
    }
}

/// Two rooms, a lamp in one of them, a hole of 4 cm x 6 cm in the wall between them.
Scene keyhole() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {6, 4, 2.5}}, diffuse(0.5));
    for (const Box& part : {Box{{3, 0, 0}, {3.1, 2, 2.5}}, Box{{3, 2.04, 0}, {3.1, 4, 2.5}},
                            Box{{3, 2, 0}, {3.1, 2.04, 1}}, Box{{3, 2, 1.06}, {3.1, 2.04, 2.5}}}) {
        add_object(scene, part, diffuse(0.5));
    }
    add_area_light(scene, Sphere{{1, 1.2, 1.8}, 0.05}, Rgb::grey(1e5));
    return scene;
}

Sensor at_point(const Vec3& position, const Vec3& normal) {
    return {"point", IlluminancePoints{{{position, normal}}}};
}

bool has_warning(const RunResult& result, std::string_view part) {
    return std::ranges::any_of(texts_of(result.warnings), [&](const std::string& warning) {
        return warning.find(part) != std::string::npos;
    });
}

TEST(Measure, WarnsWhereItFoundNoLight) {
    const Sensor sensor = at_point({4.5, 0.5, 0}, {0, 0, 1});
    const RunResult result = measure(keyhole(), {&sensor, 1}, measure_options("auto"));
    EXPECT_EQ(result.sensors[0].readings[0].estimate.value, 0);
    EXPECT_TRUE(has_warning(result, "4096 samples found no light"));
}

TEST(Measure, WarnsOfSeveralDarkSensorsOnce) {
    const Sensor dark = at_point({4.5, 0.5, 0}, {0, 0, 1});
    Sensor pair{"pair", IlluminancePoints{{{{4.5, 0.6, 0}, {0, 0, 1}}, {{1, 2, 0}, {0, 0, 1}}}}};
    const std::vector<Sensor> sensors{dark, pair};
    const RunResult result = measure(keyhole(), sensors, measure_options("auto"));
    EXPECT_TRUE(has_warning(
        result,
        "sensors \"point\", \"pair\" (1 of 2 readings): 4096 samples found no light. If light gets there"));
}

TEST(Measure, WarnsWhereFewPathsCarryTheLight) {
    RunOptions options = measure_options("path");
    options.paths = 1 << 17;
    const Sensor sensor = at_point({4, 2, 0}, {0, 0, 1});
    EXPECT_TRUE(has_warning(measure(keyhole(), {&sensor, 1}, options), "a few rare light paths"));
    const Sensor lit = at_point({1, 2, 0}, {0, 0, 1});
    for (const char* method : {"auto", "path", "local"}) {
        EXPECT_TRUE(measure(keyhole(), {&lit, 1}, measure_options(method)).warnings.empty()) << method;
    }
}

/// A small lamp above smooth metal: the first error estimate waits for its highlights, and shorter runs warn.
TEST(Measure, WaitsForSharpLight) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 2.5}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, 0, 0.01}, {4, 0, 0}, {0, 4, 0}},
               RoughConductor(RoughConductor::Parameters{Rgb::grey(0.8), 0.05}));
    add_area_light(scene, Sphere{{2, 2, 1.01}, 0.005}, Rgb::grey(1e6));
    const Sensor sensor = at_point({0, 2, 1.2}, {1, 0, 0});
    RunOptions options = measure_options("auto");
    EXPECT_TRUE(
        has_warning(measure(scene, {&sensor, 1}, options), "reflects or refracts small lamps sharply"));
    options.paths.reset();
    options.error = 0.5;
    const RunResult waited = measure(scene, {&sensor, 1}, options);
    EXPECT_GT(waited.samples, 16384U);
    EXPECT_FALSE(has_warning(waited, "sharply"));
}

/// Outdoors, the pilot's light paths often miss all that the points see, and the few rays from a point may
/// miss the sun in a mirror ball; what the pilot's rays have met tells of both.
TEST(Measure, IntervalsHoldForLightThatAShortRunMayMiss) {
    Scene scene;
    add_object(scene, Rectangle{{-2, -1.5, 0}, {8, 0, 0}, {0, 6, 0}}, diffuse(0.3));
    add_object(scene, Box{{1, 0.8, 0}, {1.6, 1.5, 1.2}}, Phong{Rgb::grey(0.3), Rgb::grey(0.4), 20});
    add_object(scene, Sphere{{2.8, 1.8, 0.5}, 0.4}, Mirror{Rgb::grey(0.9)});
    add_sky(scene);
    const Sensor sensor{"points",
                        IlluminancePoints{{{{2, 1.5, 0.8}, {0, 0, 1}}, {{3, 2.2, 0.8}, {0, 0, 1}}}}};
    const auto readings_of = [&](const char* method, std::uint64_t paths, std::uint64_t seed) {
        RunOptions options = measure_options(method);
        options.paths = paths;
        options.seed = seed;
        return measure(scene, {&sensor, 1}, options).sensors[0].readings;
    };
    const std::vector<Reading> truth = readings_of("path", 1 << 20, 1'000'000);
    std::array<int, 2> held{};
    constexpr int kSeeds = 100;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        const std::vector<Reading> readings = readings_of("auto", 2048, static_cast<std::uint64_t>(seed));
        for (std::size_t j = 0; j < 2; ++j) {
            const auto& [value, error, lower, upper] = readings[j].estimate;
            held[j] += lower <= truth[j].estimate.value && truth[j].estimate.value <= upper;
        }
    }
    // Without the light that the pilot's rays meet, 79 and 68 did.
    EXPECT_GE(held[0], 90);
    EXPECT_GE(held[1], 90);
}

/// Some of the lamps stand for all; samples of them and of the reflection are combined.
TEST(Measure, ManyLampsInAGlossyFloor) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, Phong{Rgb::grey(0.3), Rgb::grey(0.4), 40});
    for (int i = 0; i < 64; ++i) {
        const Vec3 corner{0.2 + 0.45 * (i % 8), 0.2 + 0.45 * (i / 8), 2.9};
        add_area_light(scene, Rectangle{corner, {0, 0.1, 0}, {0.1, 0, 0}}, Rgb::grey(100 + 10 * (i % 5)));
    }
    const Luminance lines{{LineOfSight{{1, 1, 1.5}, normalized(Vec3{0.3, 0.5, -1})},
                           LineOfSight{{1, 1, 1.5}, normalized(Vec3{1, 0.8, -1})}}};
    const Sensor sights{"sights", lines};
    RunOptions options;
    options.paths = 1 << 16;
    options.method = "auto";
    const RunResult chosen = measure(scene, {&sights, 1}, options);
    options.method = "path";
    const RunResult traced = measure(scene, {&sights, 1}, options);
    for (std::size_t j = 0; j < 2; ++j) {
        const statistics::Estimate &a = chosen.sensors[0].readings[j].estimate,
                                   &b = traced.sensors[0].readings[j].estimate;
        EXPECT_LT(a.standard_error, 0.01 * a.value);
        EXPECT_LT(b.standard_error, 0.01 * b.value);
        EXPECT_LT(std::abs(statistics::z_score(a, b)), 4) << a.value << ' ' << b.value;
    }
}

}  // namespace
}  // namespace stilb::run
