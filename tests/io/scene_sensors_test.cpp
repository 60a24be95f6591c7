#include "io/scene_text.h"

namespace stilb::io {
namespace {

std::string sensor(const std::string& keys) { return "[sensors.s]\n" + keys; }

std::string grid(const std::string& keys) {
    return sensor("type = \"grid\"\ncorner = [0, 0, 1]\nedge_u = [4, 0, 0]\nedge_v = [0, 2, 0]\n" + keys);
}

TEST(SceneSensors, GridMeasuresAtCellCentresUFastest) {
    const Sensor s = read_scene_text(grid("count = [4, 2]")).sensors.at(0);
    EXPECT_EQ(s.type(), "grid");
    EXPECT_EQ(s.count(), (std::array{4, 2}));
    ASSERT_EQ(s.size(), 8u);
    EXPECT_EQ(viewpoint_of(s.measurand(0)).position, (Vec3{0.5, 0.5, 1}));
    EXPECT_EQ(viewpoint_of(s.measurand(1)).position, (Vec3{1.5, 0.5, 1}));
    EXPECT_EQ(viewpoint_of(s.measurand(4)).position, (Vec3{0.5, 1.5, 1}));
    EXPECT_EQ(viewpoint_of(s.measurand(0)).normal, (Vec3{0, 0, 1})) << "edge_u x edge_v";
}

TEST(SceneSensors, GridMayHaveANormalOfItsOwn) {
    const SceneFile file = read_scene_text(grid("count = [1, 1]\nnormal = [0, 2, 0]"));
    EXPECT_EQ(viewpoint_of(file.sensors[0].measurand(0)).normal, (Vec3{0, 1, 0}));
    EXPECT_EQ(file.warnings.back(),
              "s.toml:7: sensors.s.normal: the vector has length 2; it is normalised to length 1.");
}

TEST(SceneSensors, IlluminanceAtOnePointOrMany) {
    const Sensor one =
        read_scene_text(sensor("type = \"illuminance\"\nposition = [1, 2, 3]\nnormal = [0, 0, 1]"))
            .sensors[0];
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(viewpoint_of(one.measurand(0)).position, (Vec3{1, 2, 3}));
    const Sensor two =
        read_scene_text(sensor("type = \"illuminance\"\npoints = [[1, 2, 3], [4, 5, 6]]\nnormal = [1, 0, 0]"))
            .sensors[0];
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(viewpoint_of(two.measurand(1)).position, (Vec3{4, 5, 6}));
    EXPECT_EQ(viewpoint_of(two.measurand(1)).normal, (Vec3{1, 0, 0}));
}

BodyPoint body(const Sensor& sensor, std::size_t j) { return std::get<BodyPoint>(sensor.measurand(j)); }

TEST(SceneBodies, StandAtOnePointOrMany) {
    const Sensor one = read_scene_text(sensor("type = \"cylindrical\"\nposition = [1, 2, 3]")).sensors[0];
    EXPECT_EQ(one.type(), "cylindrical");
    EXPECT_EQ(one.quantity().name, "cylindrical illuminance");
    EXPECT_EQ(one.quantity().unit, "lx");
    EXPECT_FALSE(one.measures_luminance());
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(body(one, 0).position, (Vec3{1, 2, 3}));
    EXPECT_EQ(body(one, 0).axis, (Vec3{0, 0, 1}));
    EXPECT_TRUE(one.location(0).directions.empty());
    const Sensor two =
        read_scene_text(sensor("type = \"spherical\"\npoints = [[1, 2, 3], [4, 5, 6]]")).sensors[0];
    EXPECT_EQ(two.quantity().name, "spherical illuminance");
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(body(two, 1).position, (Vec3{4, 5, 6}));
}

TEST(SceneBodies, FaceADirectionOrANormal) {
    const SceneFile file =
        read_scene_text(sensor("type = \"semicylindrical\"\nposition = [1, 2, 3]\ndirection = [0, 2, 0]"));
    EXPECT_EQ(body(file.sensors[0], 0).axis, (Vec3{0, 1, 0}));
    ASSERT_EQ(file.sensors[0].location(0).directions.size(), 1u);
    EXPECT_EQ(file.sensors[0].location(0).directions[0].name, "direction");
    EXPECT_EQ(file.warnings.back(),
              "s.toml:4: sensors.s.direction: the vector has length 2; it is normalised to length 1.");
    const Sensor hemisphere =
        read_scene_text(sensor("type = \"hemispherical\"\nposition = [1, 2, 3]\nnormal = [0, 0, -1]"))
            .sensors[0];
    EXPECT_EQ(body(hemisphere, 0).axis, (Vec3{0, 0, -1}));
    EXPECT_EQ(hemisphere.location(0).directions[0].name, "normal");
}

TEST(SceneBodies, RefuseWrongKeys) {
    EXPECT_REFUSAL(sensor("type = \"cylindrical\"\nposition = [1, 2, 3]\nnormal = [0, 0, 1]"),
                   "s.toml:4: sensors.s: unknown key \"normal\" for type \"cylindrical\". Allowed: type, "
                   "position, points, positions, array, require.");
    EXPECT_REFUSAL(sensor("type = \"spherical\""),
                   "s.toml:1: sensors.s: key \"position\", \"points\", \"positions\" or \"array\" is missing "
                   "for type \"spherical\".");
    EXPECT_REFUSAL(sensor("type = \"semicylindrical\"\nposition = [1, 2, 3]"),
                   "s.toml:1: sensors.s: key \"direction\" is missing for type \"semicylindrical\".");
    EXPECT_REFUSAL(sensor("type = \"semicylindrical\"\nposition = [1, 2, 3]\ndirection = [0, 0.6, 0.8]"),
                   "s.toml:4: sensors.s.direction: is not horizontal, but a semicylinder stands upright. "
                   "Allowed: [x, y, "
                   "0].");
    EXPECT_REFUSAL(sensor("type = \"hemispherical\"\nposition = [1, 2, 3]\nnormal = [0, 0, 0]"),
                   "s.toml:4: sensors.s.normal: [0, 0, 0] has no direction. Allowed: any other vector.");
    EXPECT_REFUSAL(
        sensor("type = \"cylindrical\"\npoints = []"),
        "s.toml:3: sensors.s.points: found no point. Allowed: [[x, y, z], ...] with one point or more.");
}

TEST(SceneSensors, RefusesUnknownTypesAndKeys) {
    EXPECT_REFUSAL(sensor("type = \"gird\""),
                   "s.toml:2: sensors.s.type: unknown type \"gird\". Did you mean \"grid\"? Allowed: "
                   "illuminance, grid, area, cylindrical, semicylindrical, hemispherical, spherical, "
                   "luminance, goniometer, ugr, dgp, derived, camera, plane.");
    EXPECT_REFUSAL(
        grid("counts = [4, 2]"),
        "s.toml:6: sensors.s: unknown key \"counts\" for type \"grid\". Did you mean \"count\"? Allowed: "
        "type, corner, positions, array, edge_u, edge_v, count, normal, require.");
}

TEST(SceneSensors, RefusesWrongCounts) {
    EXPECT_REFUSAL(grid("count = 4"),
                   "s.toml:6: sensors.s.count: found the number 4 where an array is needed.");
    EXPECT_REFUSAL(grid("count = [4]"),
                   "s.toml:6: sensors.s.count: found an array of 1 where [nu, nv] is needed.");
    EXPECT_REFUSAL(
        grid("count = [0, 4]"),
        "s.toml:6: sensors.s.count[0]: found the number 0. Allowed: a whole number from 1 to 10000000.");
    EXPECT_REFUSAL(
        grid("count = [10000, 10000]"),
        "s.toml:6: sensors.s.count: asks for 100000000 points. Allowed: 10000000 in all sensors together.");
}

TEST(SceneSensors, RefusesWrongGeometry) {
    EXPECT_REFUSAL(grid("count = [1, 1]\nnormal = [0, 0, 0]"),
                   "s.toml:7: sensors.s.normal: [0, 0, 0] has no direction. Allowed: any other vector.");
    EXPECT_REFUSAL(
        sensor("type = \"grid\"\ncorner = [0, 0, 1]\nedge_u = [4, 0, 0]\nedge_v = [2, 0, 0]\ncount = [1, 1]"),
        "s.toml:5: sensors.s.edge_v: is parallel to edge_u, so the edges span no area. Allowed: any other "
        "direction.");
    EXPECT_REFUSAL(sensor("type = \"illuminance\"\nposition = [1, 2, 3]"),
                   "s.toml:1: sensors.s: key \"normal\" is missing for type \"illuminance\".");
    EXPECT_REFUSAL(sensor("type = \"illuminance\"\nnormal = [0, 0, 1]"),
                   "s.toml:1: sensors.s: key \"position\", \"points\", \"positions\" or \"array\" is missing "
                   "for type \"illuminance\".");
    EXPECT_REFUSAL(sensor("type = \"illuminance\"\nposition = [0, 0, 1]\npoints = []\nnormal = [0, 0, 1]"),
                   "s.toml:4: sensors.s.points: contradicts \"position\", which is given too. Allowed: "
                   "one of the two.");
    EXPECT_REFUSAL(
        sensor("type = \"illuminance\"\npoints = []\nnormal = [0, 0, 1]"),
        "s.toml:3: sensors.s.points: found no point. Allowed: [[x, y, z], ...] with one point or more.");
}

}  // namespace
}  // namespace stilb::io
