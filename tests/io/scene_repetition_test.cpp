// One table for several lights or sensors.
#include "io/scene_text.h"

namespace stilb::io {
namespace {

const std::string kPoint = "[lights.bulb]\ntype = \"point\"\nflux = 100\n";
const std::string kSphere = "[lights.globe]\ntype = \"sphere\"\nradius = 0.1\nflux = 100\n";
const std::string kGrid =
    "[sensors.desk]\ntype = \"grid\"\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\ncount = [2, 2]\n";
const std::string kArray =
    "array = { origin = [1, 2, 3], step_u = [2, 0, 0], step_v = [0, 3, 0], count = [2, 3] }";

std::vector<Vec3> origins_of(const SceneFile& file) {
    std::vector<Vec3> origins;
    for (const Light& light : file.scene.lights)
        origins.push_back(std::get<PointLight>(light.source).position);
    return origins;
}

std::vector<Vec3> positions_of(const Sensor& sensor) {
    std::vector<Vec3> positions;
    for (const Measurand& measurand : sensor.measurands()) positions.push_back(position_of(measurand));
    return positions;
}

const std::vector<Vec3> kPositions{{1, 2, 3}, {3, 2, 3}, {1, 5, 3}, {3, 5, 3}, {1, 8, 3}, {3, 8, 3}};

TEST(SceneRepetition, LightsAtSeveralPositions) {
    const SceneFile file = read_scene_text(kPoint + "positions = [[1, 2, 3], [4, 5, 6]]");
    EXPECT_EQ(origins_of(file), (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(file.scene.lights[0].name, "bulb_1");
    EXPECT_EQ(file.scene.lights[1].name, "bulb_2");
    for (const Light& light : file.scene.lights)
        EXPECT_NEAR(flux_lm(file.scene, light).luminance(), 100, 1e-9);
}

TEST(SceneRepetition, AnArrayIsTheListOfItsPositions) {
    const SceneFile file = read_scene_text(kPoint + kArray);
    EXPECT_EQ(origins_of(file), kPositions);
    EXPECT_EQ(file.scene.lights.back().name, "bulb_6");
    const SceneFile row =
        read_scene_text(kPoint + "array = { origin = [1, 2, 3], step_u = [0, 0, 1], count = [3, 1] }");
    EXPECT_EQ(origins_of(row), (std::vector<Vec3>{{1, 2, 3}, {1, 2, 4}, {1, 2, 5}}));
}

TEST(SceneRepetition, CopiesShareAGroup) {
    const SceneFile file =
        read_scene_text(kPoint + "positions = [[1, 2, 3], [4, 5, 6]]\n" +
                        "[lights.lamp]\ntype = \"point\"\nflux = 1\ngroup = \"all\"\n" + kArray);
    EXPECT_EQ(file.scene.lights[1].group, "bulb");
    EXPECT_EQ(file.scene.lights[2].group, "all");
    EXPECT_EQ(read_scene_text(kPoint + "position = [1, 2, 3]").scene.lights[0].group, "");
}

TEST(SceneRepetition, EachSphereHasAnObject) {
    const SceneFile file = read_scene_text(kSphere + "positions = [[1, 2, 3], [4, 5, 6]]");
    ASSERT_EQ(file.scene.objects.size(), 2u);
    EXPECT_EQ(file.scene.objects[1].name, "globe_2");
    EXPECT_EQ(std::get<Sphere>(file.scene.objects[1].shape).center, (Vec3{4, 5, 6}));
    EXPECT_EQ(std::get<AreaLight>(file.scene.lights[1].source).object, ObjectId{1});
}

TEST(SceneRepetition, ValuesBesideTheFileApplyToAllCopies) {
    const std::vector<std::string> overrides{"lights.bulb.flux = 30", "lights.bulb.array.count = [1, 3]"};
    const SceneFile file = read_scene(kPoint + kArray, "s.toml", "", overrides);
    ASSERT_EQ(file.scene.lights.size(), 3u);
    EXPECT_NEAR(flux_lm(file.scene, file.scene.lights[2]).luminance(), 30, 1e-9);
}

TEST(SceneRepetition, SensorsOfPointsTakeAllPositionsTogether) {
    const std::string types[]{"type = \"illuminance\"\nnormal = [0, 0, 1]", "type = \"cylindrical\"",
                              "type = \"semicylindrical\"\ndirection = [1, 0, 0]",
                              "type = \"hemispherical\"\nnormal = [0, 0, 1]", "type = \"spherical\""};
    for (const std::string& type : types) {
        const std::string sensor = "[sensors.s]\n" + type + "\n";
        for (const std::string key : {"points", "positions"}) {
            const SceneFile file = read_scene_text(sensor + key + " = [[1, 2, 3], [4, 5, 6]]");
            ASSERT_EQ(file.sensors.size(), 1u);
            EXPECT_EQ(positions_of(file.sensors[0]), (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
        }
        EXPECT_EQ(positions_of(read_scene_text(sensor + kArray).sensors.at(0)), kPositions);
    }
}

TEST(SceneRepetition, LinesOfSightFromSeveralPositions) {
    const std::string sight = "[sensors.s]\ntype = \"luminance\"\npositions = [[0, 0, 1], [0, 2, 1]]\n";
    const SceneFile file = read_scene_text(sight + "targets = [[1, 0, 1], [0, 1, 1]]");
    const Sensor& sensor = file.sensors.at(0);
    EXPECT_EQ(positions_of(sensor), (std::vector<Vec3>{{0, 0, 1}, {0, 0, 1}, {0, 2, 1}, {0, 2, 1}}));
    EXPECT_EQ(std::get<LineOfSight>(sensor.measurand(1)).direction, (Vec3{0, 1, 0}));
    EXPECT_EQ(std::get<LineOfSight>(sensor.measurand(3)).direction, (Vec3{0, -1, 0}));
    const SceneFile parallel = read_scene_text(sight + "direction = [0, 0, 2]");
    EXPECT_EQ(std::get<LineOfSight>(parallel.sensors.at(0).measurand(1)).direction, (Vec3{0, 0, 1}));
    ASSERT_EQ(parallel.warnings.size(), 2u) << "the scene has no light";
    EXPECT_EQ(parallel.warnings[1],
              "s.toml:4: sensors.s.direction: the vector has length 2; it is normalised to length 1.");
}

TEST(SceneRepetition, GridsAreCopied) {
    const SceneFile file = read_scene_text(kGrid + kArray);
    ASSERT_EQ(file.sensors.size(), 6u);
    EXPECT_EQ(file.sensors[4].name, "desk_5");
    EXPECT_EQ(std::get<Grid>(file.sensors[4].kind).corner, kPositions[4]);
    EXPECT_EQ(file.sensors[4].size(), 4u);
    const SceneFile turned =
        read_scene_text(kGrid + "normal = [0, 0, 3]\npositions = [[1, 2, 3], [4, 5, 6]]");
    EXPECT_EQ(turned.warnings.size(), 2u) << "no light, and the length of the normal, once for both copies";
}

TEST(SceneRepetition, RefusesContradictions) {
    const std::string both = " contradicts \"position\", which is given too. Allowed: one of the two.";
    EXPECT_REFUSAL(kPoint + "position = [0, 0, 1]\npositions = [[0, 0, 2]]",
                   "s.toml:5: lights.bulb.positions:" + both);
    EXPECT_REFUSAL(kPoint + "position = [0, 0, 1]\n" + kArray, "s.toml:5: lights.bulb.array:" + both);
    EXPECT_REFUSAL(
        kPoint + "positions = [[0, 0, 1]]\n" + kArray,
        "s.toml:5: lights.bulb.array: contradicts \"positions\", which is given too. Allowed: one of "
        "the two.");
    EXPECT_REFUSAL(kPoint, "s.toml:1: lights.bulb: key \"position\" is missing for type \"point\".");
}

TEST(SceneRepetition, RefusesWrongArrays) {
    const auto array = [](const std::string& keys) { return kPoint + "array = { " + keys + " }"; };
    EXPECT_REFUSAL(array("origin = [0, 0, 1], count = [2, 1]"),
                   "s.toml:4: lights.bulb.array: key \"step_u\" is missing for an array.");
    EXPECT_REFUSAL(
        array("origin = [0, 0, 1], step_u = [1, 0, 0], step_v = [0, 0, 0], count = [2, 2]"),
        "s.toml:4: lights.bulb.array.step_v: [0, 0, 0] has no direction. Allowed: any other vector.");
    EXPECT_REFUSAL(array("origin = [0, 0, 1], step = [1, 0, 0], count = [2, 2]"),
                   "s.toml:4: lights.bulb.array: unknown key \"step\" for an array. Did you mean \"step_u\"? "
                   "Allowed: origin, step_u, step_v, count.");
    EXPECT_REFUSAL(array("origin = [0, 0, 1], step_u = [1, 0, 0], count = 3"),
                   "s.toml:4: lights.bulb.array.count: found the number 3 where an array is needed.");
    EXPECT_REFUSAL(
        array("origin = [0, 0, 1], step_u = [1, 0, 0], step_v = [0, 1, 0], count = [1000, 1000]"),
        "s.toml:4: lights.bulb.array.count: asks for 1000000 positions. Allowed: 100000 in an array.");
    EXPECT_REFUSAL(
        array("origin = [0, 0, 1], step_u = [1e9, 0, 0], count = [3, 1]"),
        "s.toml:4: lights.bulb.array: reaches the coordinate 2e+09. Allowed: a number from -1e9 to "
        "1e9.");
    EXPECT_REFUSAL(
        kPoint + "positions = []",
        "s.toml:4: lights.bulb.positions: found no position. Allowed: [[x, y, z], ...] with one position "
        "or more.");
    EXPECT_REFUSAL(
        kPoint + "positions = [[0, 0, 1], [0, 0]]",
        "s.toml:4: lights.bulb.positions[1]: found an array of 2 where a triple [x, y, z] is needed.");
}

TEST(SceneRepetition, MessagesNameTheTableOfTheFile) {
    EXPECT_REFUSAL(
        "[lights.bulb]\ntype = \"point\"\nflux = -1\npositions = [[0, 0, 1], [0, 0, 2]]",
        "s.toml:3: lights.bulb.flux: -1 is not allowed. Allowed: a number above 0 (from 1e-15 to 1e15).");
}

TEST(SceneRepetition, RefusesTwoOfOneName) {
    const std::string other = "[lights.bulb_2]\ntype = \"point\"\nflux = 1\nposition = [0, 0, 0]\n";
    EXPECT_REFUSAL(
        other + kPoint + "positions = [[0, 0, 1], [0, 0, 2]]",
        "s.toml:5: lights.bulb: the name \"bulb_2\" occurs twice, as the copies of a table are named "
        "after it, with _1, _2 and so on. Allowed: another name for one of the two tables.");
    EXPECT_EQ(read_scene_text(other + kPoint + "positions = [[0, 0, 1]]").scene.lights.size(), 2u);
}

TEST(SceneRepetition, OtherTypesHaveOnePlace) {
    EXPECT_REFUSAL("[lights.sky]\ntype = \"environment\"\nluminance = 1\npositions = [[0, 0, 1]]",
                   "s.toml:4: lights.sky: unknown key \"positions\" for type \"environment\". Allowed: type, "
                   "luminance, file, up, rotation, dimming, cct, color, group, on.");
}

}  // namespace
}  // namespace stilb::io
