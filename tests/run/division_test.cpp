// Light that is kept apart: shares of readings, light scenes, and lamps that are dimmed after the run.
#include "run/readings/division.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "materials/phong.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// Two lamps of a group, one of its own, and gloss.
Scene lit_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, Diffuse{{{0.7, 0.5, 0.3}}});
    add_object(scene, Box{{2.4, 1.2, 0.001}, {3.2, 2, 0.8}}, Phong{Rgb::grey(0.3), Rgb::grey(0.4), 20});
    add_area_light(scene, Rectangle{{1.1, 1.1, 2.49}, {0, 0.6, 0}, {0.6, 0, 0}}, Rgb::grey(3000));
    add_point_light(scene, {0.6, 2.4, 2}, Rgb::grey(120));
    add_point_light(scene, {2.9, 2.5, 1.6}, {{60, 50, 40}});
    scene.lights[0].name = "panel";
    scene.lights[0].power_w = 30;
    scene.lights[1].name = "left", scene.lights[1].group = "lamps";
    scene.lights[2].name = "right", scene.lights[2].group = "lamps";
    return scene;
}

std::vector<Sensor> sensors() {
    return {{"grid", Grid{{0.5, 0.5, 0.8}, {3, 0, 0}, {0, 2, 0}, {3, 2}, Vec3{0, 0, 1}}},
            {"sight", Luminance{{LineOfSight{{0.5, 2.5, 1.5}, normalized(Vec3{1, -0.6, -0.3})}}}},
            {"eye", Ugr{{{{0.5, 0.4, 1.2}, normalized(Vec3{0.6, 0.7, 0.4})}}}}};
}

RunOptions options_of(const char* method, const char* by, std::uint64_t paths, std::uint64_t seed = 1) {
    RunOptions options;
    options.method = method;
    options.by = by;
    options.paths = paths;
    options.seed = seed;
    return options;
}

std::uint64_t paths_of(const std::string& method) {
    return method == "guided" ? 1 << 9 : method == "path" ? 1 << 14 : 1 << 16;
}

class SharesOf : public testing::TestWithParam<const char*> {};

TEST_P(SharesOf, AddUpToTheReadings) {
    for (const char* by : {"light", "bounce"}) {
        const RunResult result =
            measure(lit_room(), sensors(), options_of(GetParam(), by, paths_of(GetParam())));
        for (const std::size_t s : {0, 1}) {
            const SensorResult& sensor = result.sensors[s];
            ASSERT_EQ(sensor.shares.size(), by == std::string("light") ? 2u : kBounces);
            for (std::size_t j = 0; j < sensor.readings.size(); ++j) {
                double sum = 0;
                for (const Share& share : sensor.shares) {
                    sum += share.readings[j].value;
                    EXPECT_GT(share.readings[j].value, share.name == "0" ? -1 : 0)
                        << by << ", " << share.name << "; no lamp is in sight";
                    EXPECT_LE(share.readings[j].lower, share.readings[j].value);
                }
                EXPECT_NEAR(sum, sensor.readings[j].estimate.value, 1e-5 * sum) << by;
            }
        }
        EXPECT_TRUE(result.sensors[2].shares.empty()) << "a rating is no sum of light";
    }
}

TEST_P(SharesOf, AreThoseOfLampsAlone) {
    const RunResult result =
        measure(lit_room(), sensors(), options_of(GetParam(), "light", paths_of(GetParam())));
    const std::vector<std::string> names{"panel", "lamps"};
    for (std::size_t g = 0; g < names.size(); ++g) {
        Scene alone = lit_room();
        std::erase_if(alone.lights, [&](const Light& light) { return (light.name == "panel") != (g == 0); });
        const RunResult expected =
            measure(alone, sensors(), options_of(GetParam(), "none", paths_of(GetParam()), 2));
        for (const std::size_t s : {0, 1}) {
            const Share& share = result.sensors[s].shares[g];
            EXPECT_EQ(share.name, names[g]);
            for (std::size_t j = 0; j < share.readings.size(); ++j) {
                const statistics::Estimate &a = share.readings[j],
                                           &b = expected.sensors[s].readings[j].estimate;
                EXPECT_LT(std::abs(a.value - b.value), 4 * std::hypot(a.standard_error, b.standard_error))
                    << names[g] << ", sensor " << s << ", reading " << j;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Techniques, SharesOf, testing::Values("path", "light-paths", "guided"),
                         [](const auto& technique) {
                             std::string name;
                             for (const char letter : std::string(technique.param))
                                 if (letter != '-') name += letter;
                             return name;
                         });

LightScene evening() {
    LightScene state;
    state.name = "evening";
    state.factors = {{"panel", Rgb{{0.5, 0.4, 0.3}}}, {"lamps", Rgb::grey(0.2)}, {"right", Rgb::grey(2)}};
    return state;
}

/// A scene whose lamps are so.
Scene in_the_evening() { return scene::lit(lit_room(), evening()); }

TEST(LightScenes, AreTheReadingsOfTheDimmedScene) {
    RunOptions options = options_of("light-paths", "none", 1 << 17);
    options.light_scenes = {evening()};
    const RunResult result = measure(lit_room(), sensors(), options);
    ASSERT_EQ(result.light_scenes.size(), 1u);
    const RunResult& lit = result.light_scenes[0];
    EXPECT_EQ(lit.scene_name, "evening");
    EXPECT_NEAR(lit.power.power_w.value(), 30 * (Rgb{{0.5, 0.4, 0.3}}).luminance(), 1e-9);
    const RunResult expected =
        measure(in_the_evening(), sensors(), options_of("light-paths", "none", 1 << 17, 2));
    for (std::size_t s = 0; s < 3; ++s) {
        for (std::size_t j = 0; j < lit.sensors[s].readings.size(); ++j) {
            const statistics::Estimate &a = lit.sensors[s].readings[j].estimate,
                                       &b = expected.sensors[s].readings[j].estimate;
            EXPECT_LT(std::abs(a.value - b.value), 4 * std::hypot(a.standard_error, b.standard_error)) << s;
        }
    }
    // The lamps as they are have the readings of a run without light scenes.
    const RunResult alone = measure(lit_room(), sensors(), options_of("light-paths", "none", 1 << 17));
    EXPECT_NEAR(result.sensors[0].readings[0].estimate.value, alone.sensors[0].readings[0].estimate.value,
                1e-9 * alone.sensors[0].readings[0].estimate.value);
}

/// Each run dims its lamps after its samples; a run of the dimmed scene with another seed agrees, and the
/// errors of both are as large as their difference.
TEST(DimmedLamps, AgreeWithRunsOfTheDimmedSceneOver50Pairs) {
    const LightScene state = evening();
    const Scene scene = lit_room(), dimmed = in_the_evening();
    double squares = 0, sum = 0;
    std::size_t count = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        RunOptions options = options_of("light-paths", "none", 1 << 13, seed);
        options.light_scenes = {state};
        RunState sums;
        measure(scene, sensors(), options, nullptr, nullptr, &sums);
        const RunResult a = result_of(scene, sensors(), options, sums, &state);
        const RunResult b =
            measure(dimmed, sensors(), options_of("light-paths", "none", 1 << 13, 1000 + seed));
        for (const std::size_t s : {0, 1}) {
            const statistics::Estimate &x = a.sensors[s].readings[0].estimate,
                                       &y = b.sensors[s].readings[0].estimate;
            const double z = (x.value - y.value) / std::hypot(x.standard_error, y.standard_error);
            squares += z * z;
            sum += z;
            ++count;
        }
    }
    const auto n = static_cast<double>(count);
    EXPECT_LT(std::abs(sum) / std::sqrt(n), 3.3);
    // The mean square of 100 such values is 1.06 +- 0.15, since standard errors from 32 replicates are noisy.
    EXPECT_LT(squares / n, 1.6);
    EXPECT_GT(squares / n, 0.6);
}

TEST(DimmedLamps, NeedWhatTheRunHasKeptApart) {
    const Scene scene = lit_room();
    RunState by_light, together;
    const RunOptions options = options_of("path", "light", 64), whole = options_of("path", "none", 64);
    measure(scene, sensors(), options, nullptr, nullptr, &by_light);
    measure(scene, sensors(), whole, nullptr, nullptr, &together);
    LightScene state;
    state.factors = {{"lamps", Rgb::grey(0.5)}};
    EXPECT_NO_THROW(result_of(scene, sensors(), options, by_light, &state));
    EXPECT_THROW(result_of(scene, sensors(), whole, together, &state), InputError);
    state.factors = {{"left", Rgb::grey(0.5)}};
    EXPECT_THROW(result_of(scene, sensors(), options, by_light, &state), InputError) << "one lamp of a group";
    state.factors = {};
    state.bounces = 0;
    EXPECT_THROW(result_of(scene, sensors(), options, by_light, &state), InputError);
}

/// As many channels as needed, and no more.
TEST(LightDivision, HasFewChannels) {
    const Scene scene = lit_room();
    RunOptions options;
    EXPECT_EQ(LightDivision(scene, options).channels(), nullptr);
    options.by = "light";
    EXPECT_EQ(LightDivision(scene, options).count(), 2u);
    options.by = "bounce";
    EXPECT_EQ(LightDivision(scene, options).count(), kBounces);
    for (const int bounces : {0, 5, 6, 7, 8}) {
        options.bounces = bounces;
        const LightDivision division(scene, options);
        EXPECT_EQ(division.shares().size(),
                  std::min<std::size_t>(kBounces, static_cast<std::size_t>(bounces) + 1));
        EXPECT_EQ(division.shares().back().name, bounces >= 8 ? "7+" : std::to_string(bounces));
    }
    options = {};
    LightScene state;
    state.factors = {{"lamps", Rgb::grey(0.5)}};
    options.light_scenes = {state};
    EXPECT_EQ(LightDivision(scene, options).count(), 2u);
    state.factors = {{"right", Rgb::grey(0.5)}};
    options.light_scenes.push_back(state);
    EXPECT_EQ(LightDivision(scene, options).count(), 3u);
    options.light_scenes[0].bounces = 0;
    EXPECT_EQ(LightDivision(scene, options).count(), 6u);
}

TEST(LightDivision, IsRefusedWhereAMethodKeepsLightTogether) {
    for (const char* method : {"radiosity", "particles", "ray-bundle"}) {
        RunOptions options = options_of(method, "light", 64);
        options.patch_m = 1;
        EXPECT_THROW(measure(lit_room(), sensors(), options), InputError) << method;
    }
}

}  // namespace
}  // namespace stilb::run
