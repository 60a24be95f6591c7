// Sensors of luminance: lines of sight, goniometers, cameras.
#include <cmath>

#include "io/scene_text.h"

namespace stilb::io {
namespace {

std::string sight(const std::string& keys) {
    return "[sensors.s]\ntype = \"luminance\"\nposition = [1, 2, 3]\n" + keys;
}
std::string goniometer(const std::string& keys) {
    return "[sensors.s]\ntype = \"goniometer\"\npoint = [2, 2, 0]\n" + keys;
}
std::string camera(const std::string& keys) {
    return "[sensors.s]\ntype = \"camera\"\nposition = [1, 2, 3]\n" + keys;
}

LineOfSight line(const Sensor& sensor, std::size_t j) { return std::get<LineOfSight>(sensor.measurand(j)); }

TEST(SceneLuminance, LooksAlongADirection) {
    const SceneFile file = read_scene_text(sight("direction = [0, 1, 0]"));
    const Sensor& s = file.sensors.at(0);
    EXPECT_EQ(s.name, "s");
    EXPECT_EQ(s.type(), "luminance");
    EXPECT_TRUE(s.measures_luminance());
    ASSERT_EQ(s.size(), 1u);
    EXPECT_EQ(line(s, 0).position, (Vec3{1, 2, 3}));
    EXPECT_EQ(line(s, 0).direction, (Vec3{0, 1, 0}));
    EXPECT_EQ(file.warnings.size(), 1u) << "that the scene is dark";
}

TEST(SceneLuminance, LooksAtATarget) {
    const SceneFile file = read_scene_text(sight("target = [1, 5, 7]"));
    EXPECT_LT(length(line(file.sensors[0], 0).direction - Vec3{0, 0.6, 0.8}), 1e-15);
    EXPECT_EQ(file.warnings.size(), 1u) << "that the scene is dark";
}

TEST(SceneLuminance, LooksAlongManyDirectionsOrAtManyTargets) {
    const Sensor along = read_scene_text(sight("directions = [[1, 0, 0], [0, 0, -1]]")).sensors[0];
    ASSERT_EQ(along.size(), 2u);
    EXPECT_EQ(line(along, 1).position, (Vec3{1, 2, 3}));
    EXPECT_EQ(line(along, 1).direction, (Vec3{0, 0, -1}));
    const Sensor at = read_scene_text(sight("targets = [[1, 2, 4], [0, 2, 3], [1, 0, 3]]")).sensors[0];
    ASSERT_EQ(at.size(), 3u);
    EXPECT_EQ(line(at, 0).direction, (Vec3{0, 0, 1}));
    EXPECT_EQ(line(at, 2).direction, (Vec3{0, -1, 0}));
}

TEST(SceneLuminance, WarnsOnceOfDirectionsThatAreNotUnitVectors) {
    const SceneFile one = read_scene_text(sight("direction = [0, 2, 0]"));
    EXPECT_EQ(line(one.sensors[0], 0).direction, (Vec3{0, 1, 0}));
    EXPECT_EQ(one.warnings.back(),
              "s.toml:4: sensors.s.direction: the vector has length 2; it is normalised to length 1.");
    const SceneFile many =
        read_scene_text(sight("directions = [[0, 1, 0], [0, 2, 0], [3, 0, 0], [4, 0, 0]]"));
    ASSERT_EQ(many.warnings.size(), 3u);
    EXPECT_EQ(many.warnings[1],
              "s.toml:4: sensors.s.directions[1]: the vector has length 2; it is normalised to length 1.");
    EXPECT_EQ(many.warnings[2], "s.toml:4: sensors.s.directions: likewise 2 more.");
}

TEST(SceneLuminance, RefusesWhatDoesNotSayWhereToLook) {
    EXPECT_REFUSAL(sight(""),
                   "s.toml:1: sensors.s: key \"direction\", \"target\", \"directions\" or \"targets\" is "
                   "missing for type "
                   "\"luminance\".");
    EXPECT_REFUSAL(sight("direction = [0, 1, 0]\ntargets = [[1, 5, 7]]"),
                   "s.toml:5: sensors.s.targets: contradicts \"direction\", which is given too. Allowed: one "
                   "of the two.");
    EXPECT_REFUSAL(sight("directions = [[0, 1, 0]]\ntarget = [1, 5, 7]"),
                   "s.toml:4: sensors.s.directions: contradicts \"target\", which is given too. Allowed: one "
                   "of the two.");
    EXPECT_REFUSAL(sight("direction = [0, 0, 0]"),
                   "s.toml:4: sensors.s.direction: [0, 0, 0] has no direction. Allowed: any other vector.");
    EXPECT_REFUSAL(sight("targets = [[1, 5, 7], [1, 2, 3]]"),
                   "s.toml:4: sensors.s.targets[1]: equals the position, so there is no direction to it. "
                   "Allowed: any other point.");
    EXPECT_REFUSAL(
        sight("directions = []"),
        "s.toml:4: sensors.s.directions: found no direction. Allowed: [[x, y, z], ...] with one direction or "
        "more.");
    EXPECT_REFUSAL(sight("targets = [1, 2, 3]"),
                   "s.toml:4: sensors.s.targets[0]: found the number 1 where a triple [x, y, z] is needed.");
    EXPECT_REFUSAL(
        sight("normal = [0, 0, 1]"),
        "s.toml:4: sensors.s: unknown key \"normal\" for type \"luminance\". Allowed: type, position, "
        "points, positions, array, direction, target, directions, targets, require.");
}

TEST(SceneGoniometer, MeasuresAPlane) {
    const Sensor s = read_scene_text(goniometer("normal = [0, 0, 1]\nplane = 90\nstep = 30")).sensors[0];
    EXPECT_EQ(s.type(), "goniometer");
    ASSERT_EQ(s.size(), 5u);
    EXPECT_EQ(s.location(0).angles[0].value_deg, -60);
    EXPECT_EQ(s.location(0).angles[1].value_deg, 90);
    const auto ray = std::get<EmergentRay>(s.measurand(3));
    EXPECT_EQ(ray.position, (Vec3{2, 2, 0}));
    EXPECT_EQ(ray.normal, (Vec3{0, 0, 1}));
    EXPECT_LT(length(ray.direction - Vec3{0, 0.5, std::sqrt(0.75)}), 1e-15);
}

TEST(SceneGoniometer, MeasuresTheHemisphereWithoutAPlane) {
    EXPECT_EQ(read_scene_text(goniometer("normal = [0, 0, 1]\nstep = 30")).sensors[0].size(), 25u);
}

TEST(SceneGoniometer, WarnsOfALongNormal) {
    const SceneFile file = read_scene_text(goniometer("normal = [0, 3, 0]\nplane = 0\nstep = 30"));
    EXPECT_EQ(std::get<EmergentRay>(file.sensors[0].measurand(0)).normal, (Vec3{0, 1, 0}));
    EXPECT_EQ(file.warnings.back(),
              "s.toml:4: sensors.s.normal: the vector has length 3; it is normalised to length 1.");
}

TEST(SceneGoniometer, RefusesWrongSteps) {
    const std::string allowed = " is not allowed. Allowed: an angle above 0 (from 0.001 to 90 degrees).";
    EXPECT_REFUSAL(goniometer("normal = [0, 0, 1]\nstep = 0"), "s.toml:5: sensors.s.step: 0" + allowed);
    EXPECT_REFUSAL(goniometer("normal = [0, 0, 1]\nstep = 91"), "s.toml:5: sensors.s.step: 91" + allowed);
    EXPECT_REFUSAL(goniometer("normal = [0, 0, 1]"),
                   "s.toml:1: sensors.s: key \"step\" is missing for type \"goniometer\".");
    EXPECT_REFUSAL(
        goniometer("normal = [0, 0, 1]\nstep = 0.01"),
        "s.toml:5: sensors.s.step: asks for 323964001 directions. Allowed: 10000000 readings in all "
        "sensors together.");
    EXPECT_REFUSAL(goniometer("normal = [0, 0, 0]\nstep = 5"),
                   "s.toml:4: sensors.s.normal: [0, 0, 0] has no direction. Allowed: any other vector.");
}

TEST(SceneSensors, CountsReadingsOfAllSensors) {
    const std::string grid =
        "[sensors.g]\ntype = \"grid\"\ncorner = [0, 0, 0]\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\n"
        "count = [3000, 3000]\n";
    EXPECT_REFUSAL(
        grid + goniometer("normal = [0, 0, 1]\nstep = 0.1"),
        "s.toml:7: sensors.s: the sensors up to this one have 12236401 readings. Allowed: 10000000 in all.");
}

TEST(SceneCamera, HasDefaults) {
    const Sensor s = read_scene_text(camera("target = [1, 7, 3]\nresolution = [1280, 720]")).sensors[0];
    EXPECT_EQ(s.type(), "camera");
    EXPECT_EQ(s.size(), 0u);
    ASSERT_TRUE(s.camera());
    EXPECT_EQ(s.camera()->position, (Vec3{1, 2, 3}));
    EXPECT_EQ(s.camera()->target, (Vec3{1, 7, 3}));
    EXPECT_EQ(s.camera()->up, (Vec3{0, 0, 1}));
    EXPECT_EQ(s.camera()->fov_deg, 60);
    EXPECT_EQ(s.camera()->resolution, (std::array{1280, 720}));
    EXPECT_EQ(s.camera()->projection, Projection::perspective);
    EXPECT_EQ(s.camera()->filter, PixelFilter::box);
}

TEST(SceneCamera, MayBeSetInEveryWay) {
    const SceneFile file =
        read_scene_text(camera("target = [1, 2, 0]\nup = [0, 5, 0]\nfov = 200\nresolution = [64, 32]\n"
                               "projection = \"fisheye\"\nfilter = \"gaussian\""));
    const auto& c = std::get<Camera>(file.sensors[0].kind);
    EXPECT_EQ(c.up, (Vec3{0, 1, 0}));
    EXPECT_EQ(c.fov_deg, 200);
    EXPECT_EQ(c.projection, Projection::fisheye);
    EXPECT_EQ(c.filter, PixelFilter::gaussian);
}

TEST(SceneCamera, TheFieldOfViewGoesByTheProjection) {
    const auto with = [](const std::string& keys) {
        return camera("target = [1, 7, 3]\nresolution = [4, 4]\n" + keys);
    };
    EXPECT_EQ(read_scene_text(with("projection = \"fisheye\"")).sensors[0].camera()->fov_deg, 180);
    EXPECT_EQ(read_scene_text(with("projection = \"panorama\"")).sensors[0].camera()->fov_deg, 360);
    EXPECT_EQ(read_scene_text(with("projection = \"fisheye\"\nfov = 360")).sensors[0].camera()->fov_deg, 360);
    EXPECT_REFUSAL(with("fov = 180"),
                   "s.toml:6: sensors.s.fov: 180 is not allowed. Allowed: an angle above 0 and below 180 "
                   "degrees (from 0.001 to 179.9).");
    EXPECT_REFUSAL(
        with("fov = 361\nprojection = \"panorama\""),
        "s.toml:6: sensors.s.fov: 361 is not allowed. Allowed: an angle above 0 (from 0.001 to 360 "
        "degrees).");
}

TEST(SceneCamera, RefusesWhatMakesNoPicture) {
    EXPECT_REFUSAL(camera("target = [1, 2, 3]\nresolution = [4, 4]"),
                   "s.toml:4: sensors.s.target: equals the position, so there is no direction to it. "
                   "Allowed: any other point.");
    EXPECT_REFUSAL(camera("target = [1, 2, 0]\nresolution = [4, 4]"),
                   "s.toml:4: sensors.s.target: lies straight above or below the position, so the picture "
                   "has no upward side. Allowed: any other point, or another \"up\" than [0, 0, 1].");
    EXPECT_REFUSAL(camera("target = [1, 7, 3]\nup = [0, -2, 0]\nresolution = [4, 4]"),
                   "s.toml:5: sensors.s.up: is parallel to the direction from position to target, so the "
                   "picture has no upward side. Allowed: any other direction.");
    EXPECT_REFUSAL(camera("target = [1, 7, 3]\nup = [0, 0, 0]\nresolution = [4, 4]"),
                   "s.toml:5: sensors.s.up: [0, 0, 0] has no direction. Allowed: any other vector.");
    EXPECT_REFUSAL(camera("target = [1, 7, 3]"),
                   "s.toml:1: sensors.s: key \"resolution\" is missing for type \"camera\".");
    EXPECT_REFUSAL(camera("target = [1, 7, 3]\nresolution = [1280]"),
                   "s.toml:5: sensors.s.resolution: found an array of 1 where [width, height] is needed.");
    EXPECT_REFUSAL(camera("target = [1, 7, 3]\nresolution = [0, 4]"),
                   "s.toml:5: sensors.s.resolution[0]: found the number 0. Allowed: a whole number from 1 to "
                   "100000.");
    EXPECT_REFUSAL(camera("target = [1, 7, 3]\nresolution = [10000, 10000]"),
                   "s.toml:5: sensors.s.resolution: asks for 100000000 pixels. Allowed: 64000000 in a "
                   "picture.");
    EXPECT_REFUSAL(
        camera("target = [1, 7, 3]\nresolution = [4, 4]\nprojection = \"fish-eye\""),
        "s.toml:6: sensors.s.projection: unknown projection \"fish-eye\". Did you mean \"fisheye\"? Allowed: "
        "perspective, fisheye, panorama.");
    EXPECT_REFUSAL(camera("target = [1, 7, 3]\nresolution = [4, 4]\nfilter = \"lanczos\""),
                   "s.toml:6: sensors.s.filter: unknown filter \"lanczos\". Allowed: box, gaussian.");
}

}  // namespace
}  // namespace stilb::io
