#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/luminance_results.h"
#include "io/results/results_file.h"
#include "io/results/results_writer.h"

namespace stilb::io {
namespace {

using Json = nlohmann::json;

Json json_of(const RunResult& made) { return Json::parse(to_json(made, "room.toml"))["sensors"]; }

TEST(ResultsJson, LuminancesSayWhereTheLightComesFrom) {
    const Json view = json_of(luminance_results())[0];
    EXPECT_EQ(view["type"], "luminance");
    EXPECT_EQ(view["quantity"], "luminance");
    EXPECT_EQ(view["unit"], "cd/m2");
    EXPECT_EQ(view["values"][0], Json::parse(R"({"position": [2.0, 0.0, 1.0], "direction": [0.0, 1.0, 0.0],
        "hit": [2.0, 4.0, 1.0], "value": 100.0, "standard_error": 1.0, "interval": [98.0, 102.0],
        "rgb": [110.0, 100.0, 90.0]})"));
    EXPECT_TRUE(view["values"][1]["hit"].is_null());
}

/// A reader that distinguishes integers from other numbers never gets an integer; no digit is lost.
TEST(ResultsJson, ReadingsAreNumbersWithAllTheirDigits) {
    RunResult made = luminance_results();
    for (const double value : {0.0, 1.0, 1e5, 1e22, 1.0 / 3, 5e-324, 1.7976931348623157e308}) {
        made.sensors[0].readings[0].estimate.value = value;
        const Json written = json_of(made)[0]["values"][0]["value"];
        EXPECT_TRUE(written.is_number_float()) << value;
        EXPECT_EQ(written.get<double>(), value);
    }
}

TEST(ResultsJson, UnknownSubPointsAreNull) {
    RunResult made = luminance_results();
    made.sensors[0].sub_points.clear();
    const Json values = json_of(made)[0]["values"];
    ASSERT_FALSE(values.empty());
    for (const Json& value : values) EXPECT_TRUE(value.at("hit").is_null());
}

TEST(ResultsJson, GoniometersHaveAngles) {
    const Json solid = json_of(luminance_results())[1];
    EXPECT_EQ(solid["type"], "goniometer");
    EXPECT_EQ(solid["quantity"], "luminance");
    EXPECT_EQ(solid["values"][1], Json::parse(R"({"position": [2.0, 2.0, 0.0], "normal": [0.0, 0.0, 1.0],
        "direction": [0.0, 0.0, 1.0], "hit": [2.0, 2.0, 0.0], "theta": 0.0, "phi": 90.0, "value": 30.0,
        "standard_error": 1.0, "interval": [28.0, 32.0], "rgb": [40.0, 30.0, 20.0]})"));
    const Json& last = solid["values"][2];
    EXPECT_EQ(last["theta"], 60);
    EXPECT_EQ(last["phi"], 90);
    EXPECT_NEAR(last["direction"][1].get<double>(), std::sqrt(0.75), 1e-15);
    EXPECT_NEAR(last["direction"][2].get<double>(), 0.5, 1e-15);
}

TEST(ResultsJson, BodiesHaveAnAxisWhereItIsNotTheVertical) {
    RunResult made = luminance_results();
    const Sensor semicylinder{"face", Semicylindrical{{{1, 2, 3}}, {0, 1, 0}}};
    const Sensor sphere{"middle", Spherical{{{1, 2, 3}}}};
    made.sensors = {{semicylinder, {reading(100)}, {}, {}, 0.02}, {sphere, {reading(200)}, {}, {}, 0.02}};
    const Json face = json_of(made)[0], middle = json_of(made)[1];
    EXPECT_EQ(face["type"], "semicylindrical");
    EXPECT_EQ(face["quantity"], "semicylindrical illuminance");
    EXPECT_EQ(face["unit"], "lx");
    EXPECT_EQ(face["values"][0], Json::parse(R"({"position": [1.0, 2.0, 3.0], "direction": [0.0, 1.0, 0.0],
        "value": 100.0, "standard_error": 1.0, "interval": [98.0, 102.0], "rgb": [110.0, 100.0, 90.0]})"));
    EXPECT_TRUE(face["summary"].contains("uniformity"));
    EXPECT_EQ(middle["values"][0], Json::parse(R"({"position": [1.0, 2.0, 3.0], "value": 200.0,
        "standard_error": 1.0, "interval": [198.0, 202.0], "rgb": [210.0, 200.0, 190.0]})"));
}

TEST(ResultsJson, LuminancesHaveNoUniformity) {
    for (const Json& sensor : json_of(luminance_results())) {
        EXPECT_EQ(sensor["summary"], Json::parse(R"({"mean": 150.0, "minimum": 100.0, "maximum": 200.0,
            "mean_interval": [148.0, 152.0], "minimum_interval": [98.0, 102.0],
            "maximum_interval": [198.0, 202.0]})"));
    }
}

TEST(ResultsJson, NamesTheTechniqueAndWhatASampleIs) {
    const Json json = Json::parse(to_json(luminance_results(), "room.toml"));
    EXPECT_EQ(json["format"], 1);
    EXPECT_EQ(json["method"], "auto");
    EXPECT_EQ(json["technique"], "light-paths");
    EXPECT_EQ(json["sample"], "a path of light from a lamp, which all readings share");
}

TEST(ResultsJson, PatchesSayWhatBecameOfLights) {
    RunResult made = luminance_results();
    made.patches = patch_report();
    const Json json = Json::parse(to_json(made, "room.toml"));
    EXPECT_EQ(json["first_shot_set_up_s"], 0.125);
    EXPECT_EQ(json["patches"], Json::parse(R"({"count": 1000, "size_m": 0.25, "first_shot": {
        "variant": "incoming", "resolution": 256, "missed": 3, "bytes_per_patch": 71.5, "lights": [
        {"name": "bulb", "replaced": true, "samples": 1, "reason": "a point"},
        {"name": "panel", "replaced": false, "samples": 0, "reason": "large"}]}})"));
}

TEST(ResultsJson, WithoutItemBuffersThereIsNoResolution) {
    RunResult made = luminance_results();
    made.patches = patch_report();
    made.patches->resolution.reset();
    const Json json = Json::parse(to_json(made, "room.toml"));
    EXPECT_TRUE(json["patches"]["first_shot"].at("resolution").is_null());
}

TEST(ResultsJson, WithoutPatchesThereIsNoReport) {
    const RunResult made = luminance_results();
    const Json json = Json::parse(to_json(made, "room.toml"));
    EXPECT_FALSE(json.contains("patches"));
    EXPECT_FALSE(json.contains("first_shot_set_up_s"));
}

TEST(ResultsJson, GridsAmongLuminancesAreReadBack) {
    RunResult made = luminance_results();
    const Sensor desk{"desk", Grid{{0, 0, 0.75}, {2, 0, 0}, {0, 1, 0}, {2, 1}}};
    made.sensors.push_back({desk, {reading(500), reading(510)}, {}, {}, 0.01});
    const ResultsFile read = read_results(to_json(made, "room.toml"), "room.json");
    ASSERT_EQ(read.grids.size(), 1u);
    EXPECT_EQ(read.grids[0].name, "desk");
    ASSERT_EQ(read.grids[0].values.size(), 2u);
    EXPECT_EQ(read.grids[0].values[0].value, 500);
    EXPECT_EQ(read.grids[0].values[1].value, 510);
    EXPECT_EQ(read.grids[0].unit, "lx");
}

}  // namespace
}  // namespace stilb::io
