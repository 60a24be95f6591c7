// Derived values, and what is required of sensors.
#include "io/scene_text.h"

namespace stilb::io {
namespace {

/// A grid of 8 points, a point, a line of sight and a camera; then the text.
std::string with_sensors(const std::string& text) {
    return "[sensors.desk]\ntype = \"grid\"\ncorner = [0, 0, 1]\nedge_u = [4, 0, 0]\nedge_v = [0, 2, 0]\n"
           "count = [4, 2]\n"
           "[sensors.wall]\ntype = \"illuminance\"\nposition = [1, 2, 3]\nnormal = [1, 0, 0]\n"
           "[sensors.sight]\ntype = \"luminance\"\nposition = [1, 2, 3]\ndirection = [1, 0, 0]\n"
           "[sensors.view]\ntype = \"camera\"\nposition = [0, 0, 1]\ntarget = [1, 0, 1]\nresolution = [4, "
           "3]\n" +
           text;
}

std::string derived(const std::string& formula) {
    return with_sensors("[sensors.d]\ntype = \"derived\"\nvalue = '" + formula + "'\n");
}

TEST(SceneDerived, HasTheUnitOfItsFormula) {
    const SceneFile file = read_scene_text(derived("desk.mean / wall"));
    const Sensor& sensor = file.sensors.at(4);
    EXPECT_EQ(sensor.type(), "derived");
    EXPECT_EQ(sensor.size(), 0U);
    EXPECT_EQ(sensor.quantity().name, "derived value");
    EXPECT_EQ(sensor.quantity().unit, "");
    EXPECT_FALSE(sensor.measures_luminance());
    ASSERT_TRUE(sensor.derived());
    EXPECT_EQ(sensor.derived()->formula.text(), "desk.mean / wall");
    EXPECT_EQ(read_scene_text(derived("desk.maximum - desk[7]")).sensors[4].quantity().unit, "lx");
    EXPECT_EQ(read_scene_text(derived("sight - 10")).sensors[4].quantity().unit, "cd/m2");
}

TEST(SceneDerived, MayStandBeforeItsSensors) {
    EXPECT_EQ(read_scene_text("[sensors.a]\ntype = \"derived\"\nvalue = \"wall * 2\"\n" + with_sensors(""))
                  .sensors[0]
                  .quantity()
                  .unit,
              "lx");
}

TEST(SceneDerived, RefusesFormulasThatDoNotFit) {
    EXPECT_REFUSAL(
        derived("desk.mean / wal"),
        "s.toml:22: sensors.d.value: there is no sensor \"wal\" to measure. Did you mean \"wall\"? "
        "Allowed: desk, wall, sight.");
    EXPECT_REFUSAL(derived("desk"),
                   "s.toml:22: sensors.d.value: sensor \"desk\" has 8 readings. Write one of them, such as "
                   "desk[0], or a statistic: mean, minimum, maximum, uniformity, diversity.");
    EXPECT_REFUSAL(
        derived("desk[8]"),
        "s.toml:22: sensors.d.value: desk[8]: the readings of the sensor have the numbers 0 to 7.");
    EXPECT_REFUSAL(derived("view"),
                   "s.toml:22: sensors.d.value: sensor \"view\" is a camera, which has no readings.");
    EXPECT_REFUSAL(derived("sight.uniformity"),
                   "s.toml:22: sensors.d.value: sight.uniformity: luminances have no uniformity. Allowed: "
                   "mean, minimum, maximum.");
    EXPECT_REFUSAL(derived("wall + sight"),
                   "s.toml:22: sensors.d.value: adds or subtracts a value in lx and a value in cd/m2. "
                   "Expected: values of one unit.");
    EXPECT_REFUSAL(
        derived("wall +"),
        "s.toml:22: sensors.d.value: expected a number, a sensor or \"(\" at character 7, found the "
        "end.");
    EXPECT_REFUSAL(
        derived("wall * 2") + "[sensors.e]\ntype = \"derived\"\nvalue = \"d + wall\"\n",
        "s.toml:25: sensors.e.value: \"d\" is itself a derived value. Write its formula here: wall "
        "* 2.");
}

TEST(SceneRequirements, OfGlareAreRatings) {
    const std::string eye =
        "[sensors.eye]\ntype = \"ugr\"\nposition = [1, 2, 1.2]\ndirection = [1, 0, 0]\nrequire = ";
    const SceneFile file = read_scene_text(eye + "{ ugr = 19 }\n");
    const Requirement& requirement = file.sensors.at(0).requirements.at(0);
    EXPECT_EQ(requirement.criterion->key, "ugr");
    EXPECT_EQ(requirement.criterion->statistic, Statistic::maximum);
    EXPECT_EQ(requirement.criterion->limit, sensors::Limit::at_most);
    EXPECT_EQ(requirement.limit, 19);
    EXPECT_REFUSAL(eye + "{ mean = 19 }\n",
                   "s.toml:5: sensors.eye.require: unknown key \"mean\" for type \"ugr\". Allowed: ugr.");
    EXPECT_REFUSAL(eye + "{ ugr = -1 }\n",
                   "s.toml:5: sensors.eye.require.ugr: -1 is not allowed. Allowed: a rating from 0 to 100.");
    EXPECT_REFUSAL(with_sensors("[sensors.e]\ntype = \"spherical\"\nposition = [1, 2, 1.2]\n"
                                "require = { ugr = 19 }\n"),
                   "s.toml:23: sensors.e.require: unknown key \"ugr\" for type \"spherical\". Allowed: mean, "
                   "minimum, maximum, uniformity, diversity.");
}

TEST(SceneRequirements, AreLimitsOfStatistics) {
    const SceneFile file =
        read_scene_text(with_sensors("[sensors.d]\ntype = \"derived\"\nvalue = \"desk.mean / wall\"\n"
                                     "require = { minimum = 0.3, maximum = 0.6 }\n"
                                     "[sensors.e]\ntype = \"cylindrical\"\nposition = [1, 2, 1.2]\n"
                                     "require = { mean = 150, uniformity = 0.1, diversity = 0.05 }\n"));
    ASSERT_EQ(file.sensors.at(4).requirements.size(), 2U);
    const Requirement& most = file.sensors[4].requirements[1];
    EXPECT_EQ(most.criterion->key, "maximum");
    EXPECT_EQ(most.criterion->limit, sensors::Limit::at_most);
    EXPECT_EQ(most.limit, 0.6);
    ASSERT_EQ(file.sensors.at(5).requirements.size(), 3U);
    const Requirement& least = file.sensors[5].requirements[0];
    EXPECT_EQ(least.criterion->statistic, Statistic::mean);
    EXPECT_EQ(least.criterion->limit, sensors::Limit::at_least);
    EXPECT_EQ(least.limit, 150);
    EXPECT_TRUE(file.sensors[0].requirements.empty());
}

TEST(SceneRequirements, RefusesWhatIsNoRequirement) {
    const auto require = [](const std::string& table) {
        return "[sensors.s]\ntype = \"luminance\"\nposition = [1, 2, 3]\ndirection = [1, 0, 0]\nrequire = " +
               table;
    };
    EXPECT_REFUSAL(require("{ mean = -1 }"),
                   "s.toml:5: sensors.s.require.mean: -1 is not allowed. Allowed: a number from 0 to 1e15.");
    EXPECT_REFUSAL(require("{ uniformity = 0.6 }"),
                   "s.toml:5: sensors.s.require: unknown key \"uniformity\" for type \"luminance\". Allowed: "
                   "mean, minimum, maximum.");
    EXPECT_REFUSAL(require("{}"),
                   "s.toml:5: sensors.s.require: is empty. Allowed: mean, minimum, maximum, or no require.");
    EXPECT_REFUSAL(require("500"),
                   "s.toml:5: sensors.s.require: found the number 500 where a table is needed.");
    EXPECT_REFUSAL(
        "[sensors.s]\ntype = \"cylindrical\"\nposition = [1, 2, 3]\nrequire = { uniformity = 60 }",
        "s.toml:4: sensors.s.require.uniformity: 60 is not allowed. Allowed: a share from 0 to 1.");
    EXPECT_REFUSAL(
        "[sensors.s]\ntype = \"camera\"\nposition = [0, 0, 1]\ntarget = [1, 0, 1]\nresolution = [4, "
        "3]\nrequire = { mean = 5 }",
        "s.toml:6: sensors.s: unknown key \"require\" for type \"camera\". Allowed: type, position, "
        "target, up, fov, resolution, projection, filter.");
}

TEST(SceneRun, HasATarget) {
    EXPECT_EQ(read_scene_text("[run]\nerror = 0.01\ntarget = \"mean\"").run.target, "mean");
    EXPECT_EQ(read_scene_text("[run]\nerror = 0.01").run.target, "readings");
    EXPECT_REFUSAL(
        "[run]\ntarget = \"means\"",
        "s.toml:2: run.target: unknown target \"means\". Did you mean \"mean\"? Allowed: readings, "
        "mean.");
}

}  // namespace
}  // namespace stilb::io
