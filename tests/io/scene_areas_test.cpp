#include "io/scene_text.h"
#include "run/run.h"

namespace stilb::io {
namespace {

std::string area(const std::string& keys) { return "[sensors.task]\ntype = \"area\"\n" + keys; }
const std::string kCorners = "corners = [[0, 0], [4, 0], [4, 3], [0, 3]]\nheight = 0.75\n";

TEST(SceneAreas, AreRectanglesOrPolygons) {
    const SceneFile flat = read_scene_text(area(kCorners));
    ASSERT_EQ(flat.sensors.size(), 1U);
    EXPECT_EQ(flat.sensors[0].type(), "area");
    EXPECT_EQ(flat.sensors[0].size(), 48U);  // p(4) = 0.527: 8 x 6 cells of half a metre
    const SceneFile spatial =
        read_scene_text(area("corners = [[0, 0, 0.75], [4, 0, 0.75], [4, 3, 0.75], [0, 3, 0.75]]"));
    const SceneFile rectangle =
        read_scene_text(area("corner = [0, 0, 0.75]\nedge_u = [4, 0, 0]\nedge_v = [0, 3, 0]"));
    for (const SceneFile* other : {&spatial, &rectangle}) {
        ASSERT_EQ(other->sensors[0].size(), flat.sensors[0].size());
        for (std::size_t j = 0; j < flat.sensors[0].size(); ++j) {
            EXPECT_EQ(viewpoint_of(other->sensors[0].measurand(j)).position,
                      viewpoint_of(flat.sensors[0].measurand(j)).position);
        }
    }
    EXPECT_EQ(read_scene_text(area(kCorners + "spacing = 0.5\nholes = [[[1, 1], [2, 1], [2, 2], [1, 2]]]"))
                  .sensors[0]
                  .size(),
              44U);
}

TEST(SceneAreas, HaveBandsAsSensorsOfTheirOwn) {
    const SceneFile file = read_scene_text(
        area(kCorners + "surround = { width = 0.5, require = { mean = 300, uniformity = 0.4 } }\n"
                        "background = 3\nrequire = { mean = 500 }\n") +
        "[sensors.ratio]\ntype = \"derived\"\nvalue = \"task.surround.mean / task.mean\"\n");
    ASSERT_EQ(file.sensors.size(), 4U);
    EXPECT_EQ(file.sensors[0].name, "task");
    EXPECT_EQ(file.sensors[0].requirements.size(), 1U);
    EXPECT_EQ(file.sensors[1].name, "task.surround");
    EXPECT_EQ(file.sensors[1].requirements.size(), 2U);
    EXPECT_EQ(file.sensors[2].name, "task.background");
    EXPECT_TRUE(file.sensors[2].requirements.empty());
    EXPECT_EQ(std::get<Area>(file.sensors[1].kind).band_m, (std::array{0., 0.5}));
    EXPECT_EQ(std::get<Area>(file.sensors[2].kind).band_m, (std::array{0.5, 3.5}));
}

TEST(SceneAreas, RefuseWrongKeys) {
    EXPECT_REFUSAL(
        area("height = 1"),
        "s.toml:1: sensors.task: key \"corners\", \"corner\", \"object\" or \"room\" is missing for type "
        "\"area\".");
    EXPECT_REFUSAL(
        area("corners = [[0, 0], [1, 0], [1, 1]]"),
        "s.toml:3: sensors.task.corners[0]: found a pair [x, y], but no \"height\". Allowed: triples "
        "[x, y, z], or \"height\" as well.");
    EXPECT_REFUSAL(area("corners = [[0, 0, 1], [1, 0, 1], [1, 1, 1]]\nheight = 1"),
                   "s.toml:3: sensors.task.corners[0]: found a triple [x, y, z] beside \"height\". Allowed: "
                   "pairs [x, y], or no \"height\".");
    EXPECT_REFUSAL(
        area(kCorners + "edge_u = [1, 0, 0]"),
        "s.toml:5: sensors.task.edge_u: contradicts \"corners\", which is given too. Allowed: one of "
        "the two.");
    EXPECT_REFUSAL(
        area("corner = [0, 0, 0]\nedge_u = [4, 0, 0]\nedge_v = [0, 3, 0]\nheight = 1"),
        "s.toml:6: sensors.task.height: contradicts \"corner\", which is given too. Allowed: one of "
        "the two.");
    EXPECT_REFUSAL(
        area("corners = [[0, 0], [4, 3], [4, 0], [0, 3]]\nheight = 1"),
        "s.toml:3: sensors.task.corners: the area has no extent. Allowed: corners that are not on one "
        "line.");
    EXPECT_REFUSAL(
        area("corners = [[0, 0], [4, 4], [4, 0], [0, 3]]\nheight = 1"),
        "s.toml:3: sensors.task.corners: crosses or touches itself: the edges from corners 0 and 2, "
        "counted from 0, meet. Allowed: a simple polygon.");
    EXPECT_REFUSAL(
        area(kCorners + "surround = 0"),
        "s.toml:5: sensors.task.surround: 0 is not allowed. Allowed: a width from 0.001 to 1e6 m.");
    EXPECT_REFUSAL(area(kCorners + "surround = { width = 0.5, requires = {} }"),
                   "s.toml:5: sensors.task.surround: unknown key \"requires\". Did you mean \"require\"? "
                   "Allowed: width, require.");
    EXPECT_REFUSAL(
        area(kCorners + "spacing = 0"),
        "s.toml:5: sensors.task.spacing: 0 is not allowed. Allowed: a length from 0.001 to 1e6 m.");
    EXPECT_REFUSAL(area(kCorners + "background = 100000\nspacing = 1"),
                   "s.toml:5: sensors.task.background: asks for a raster of 200004 x 200003 points. Allowed: "
                   "10000000 readings in all sensors together.");
    EXPECT_REFUSAL(
        "[sensors.\"task.surround\"]\ntype = \"spherical\"\nposition = [0, 0, 0]\n" +
            area(kCorners + "surround = 0.5"),
        "s.toml:1: sensors.\"task.surround\": has the name of a band around an area, or of one of several "
        "planes, which are sensors, "
        "too. Allowed: another name.");
}

const std::string kRoomWithAreas =
    "[materials.white]\ntype = \"diffuse\"\nreflectance = 0.7\n"
    "[objects.room]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [4, 3, 2]\nmaterial = \"white\"\n"
    "[objects.screen]\nshape = \"rectangle\"\ncorner = [1, 1, 0]\nedge_u = [0, 0, 1]\nedge_v = [2, 0, 0]\n"
    "material = \"white\"\n"
    "[objects.ball]\nshape = \"sphere\"\ncenter = [1, 1, 1]\nradius = 0.1\nmaterial = \"white\"\n";

std::vector<MeasuringPoint> points_of(const std::string& keys) {
    return std::get<Area>(read_scene_text(kRoomWithAreas + area(keys)).sensors.at(0).kind).points;
}

TEST(SceneAreas, AreFacesOfObjects) {
    // The largest wall is 4 m x 2 m: d = 2, p = 0.325, 6 cells of 0.333 m upwards.
    const std::vector<MeasuringPoint> walls = points_of("object = \"room\"\npart = \"walls\"");
    EXPECT_EQ(walls.size(), 2u * (12 + 9) * 6);
    for (const auto& [position, normal] : walls) {
        EXPECT_EQ(normal.z, 0);
        EXPECT_GT(dot(Vec3{2, 1.5, 1} - position, normal), 1);  // inside
    }
    for (const auto& [position, normal] : points_of("object = \"room\"\npart = \"ceiling\"\nspacing = 1")) {
        EXPECT_NEAR(position.z, 2, 1e-12);
        EXPECT_EQ(normal, (Vec3{0, 0, -1}));
    }
    EXPECT_EQ(points_of("object = \"room\"\npart = \"ceiling\"\nspacing = 1").size(), 12u);
    EXPECT_EQ(points_of("object = \"room\"\nspacing = 1").size(), 2u * (12 + 8 + 6));
    // A rectangle is measured on its front.
    const std::vector<MeasuringPoint> screen = points_of("object = \"screen\"\nspacing = 0.5");
    EXPECT_EQ(screen.size(), 8u);
    EXPECT_EQ(screen[0].normal, (Vec3{0, 1, 0}));
    EXPECT_EQ(points_of("object = [\"screen\", \"room\"]\npart = \"walls\"\nspacing = 1").size(), 2u + 28u);
}

TEST(SceneAreas, AreFacesOfARoom) {
    EXPECT_EQ(points_of("room = [2, 1, 0.5]\npart = \"walls\"").size(), 2u * (12 + 9) * 6);
    EXPECT_EQ(points_of("room = [2, 1, 0.5]\nspacing = 1").size(), 2u * (12 + 8 + 6));
    const auto refusal_of = [](const std::string& keys) { return refusal(kRoomWithAreas + area(keys)); };
    EXPECT_EQ(
        refusal_of("room = [5, 1, 1]"),
        "s.toml:22: sensors.task.room: lies in no room. A room has a level floor of 1 m² or more, walls, "
        "and a ceiling 1.8 m or more above. Allowed: a point in a room, or \"object\" in place of "
        "\"room\".");
    EXPECT_EQ(
        refusal_of("room = [2, 1, 1]\nobject = \"room\""),
        "s.toml:22: sensors.task.room: contradicts \"object\", which is given too. Allowed: one of the two.");
    EXPECT_EQ(refusal_of("room = [2, 1, 1]\nsurround = 0.5"),
              "s.toml:23: sensors.task.surround: does not go with \"room\": faces have normals of their own, "
              "and no bands around them. Allowed: one of the two.");
}

/// In a room of 4 m x 3 m.
TEST(SceneAreas, HaveBandsThatEndAtTheWalls) {
    const std::string bands = "surround = { width = 0.5, require = { mean = 300 } }\nbackground = 3\n";
    const SceneFile desk = read_scene_text(
        kRoomWithAreas + area("corners = [[1, 1], [2.6, 1], [2.6, 1.8], [1, 1.8]]\nheight = 0.75\n" + bands));
    ASSERT_EQ(desk.sensors.size(), 3u);
    for (const Sensor& sensor : desk.sensors) {
        for (std::size_t j = 0; j < sensor.size(); ++j) {
            const Vec3 p = viewpoint_of(sensor.measurand(j)).position;
            EXPECT_TRUE(p.x > 0 && p.x < 4 && p.y > 0 && p.y < 3) << p.x << " " << p.y;
        }
    }
    // The surround is within the room: 2.6 m x 1.8 m with round corners, without the desk.
    const double cell_m2 =
        std::get<Area>(desk.sensors[1].kind).cell_m[0] * std::get<Area>(desk.sensors[1].kind).cell_m[1];
    EXPECT_NEAR(static_cast<double>(desk.sensors[1].size()) * cell_m2, 2 * 0.5 * 2.4 + kPi * 0.25, 0.1);
    ASSERT_EQ(desk.warnings.size(), 1u);
    EXPECT_EQ(desk.warnings[0], "s.toml: no light: the scene is dark.");
    // There is nothing around an area that fills the room.
    const SceneFile filled = read_scene_text(kRoomWithAreas + area(kCorners + bands));
    EXPECT_EQ(filled.sensors.size(), 1u);
    ASSERT_EQ(filled.warnings.size(), 3u);
    EXPECT_EQ(
        filled.warnings[1],
        "s.toml:24: sensors.task.surround: no place of the band lies in the room of the area, whose walls "
        "end it: it is not measured, and no requirement on it is rated.");
}

/// A closed room absorbs the flux of its lamp: the mean over all faces is known.
TEST(SceneAreas, OfAWholeRoomHaveTheMeanOfItsFlux) {
    for (const char* whole : {"object = \"room\"", "room = [1, 1, 1]"}) {
        const SceneFile file = read_scene_text(
            "[materials.white]\ntype = \"diffuse\"\nreflectance = 0.7\n"
            "[objects.room]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [4, 3, 2]\nmaterial = \"white\"\n"
            "[lights.bulb]\ntype = \"point\"\nposition = [1.5, 1, 1.2]\nflux = 1000\n" +
            area(whole + std::string("\nspacing = 0.25")));
        RunOptions options;
        options.paths = 1 << 11;
        const RunResult result = run::measure(file.scene, file.sensors, options);
        const statistics::Estimate& mean = result.sensors[0].summary.mean;
        const double exact_lx = 1000 / (52 * (1 - 0.7));
        EXPECT_NEAR(mean.value, exact_lx, 4 * mean.standard_error + 0.002 * exact_lx);  // of the raster
        EXPECT_LT(mean.standard_error, 0.01 * exact_lx);
        EXPECT_EQ(std::get<Area>(result.sensors[0].sensor.kind).left_out, 0u);
    }
}

TEST(SceneAreas, RefuseObjectsWithoutSuchFaces) {
    const auto refusal_of = [](const std::string& keys) { return refusal(kRoomWithAreas + area(keys)); };
    EXPECT_EQ(refusal_of("object = \"rom\""),
              "s.toml:22: sensors.task.object: unknown object \"rom\". Did you mean \"room\"? Allowed: room, "
              "screen, ball.");
    EXPECT_EQ(
        refusal_of("object = \"ball\""),
        "s.toml:22: sensors.task.object: object \"ball\" has no plane faces. Allowed: meshes, polygons, "
        "boxes and rectangles.");
    EXPECT_EQ(
        refusal_of("object = \"screen\"\npart = \"ceiling\""),
        "s.toml:23: sensors.task.part: no face of the object is part of the ceiling: closed objects are "
        "measured inside, others on their front. Allowed: another part or object.");
    EXPECT_EQ(
        refusal_of("object = \"room\"\npart = \"wall\""),
        "s.toml:23: sensors.task.part: unknown part \"wall\". Did you mean \"all\"? Allowed: all, walls, "
        "ceiling, floor.");
    EXPECT_EQ(
        refusal_of("object = \"room\"\nsurround = 0.5"),
        "s.toml:23: sensors.task.surround: does not go with \"object\": faces have normals of their own, and "
        "no bands around them. Allowed: one of the two.");
    EXPECT_EQ(
        refusal_of("object = \"room\"\nheight = 1"),
        "s.toml:23: sensors.task.height: contradicts \"object\", which is given too. Allowed: one of the "
        "two.");
    EXPECT_EQ(
        refusal_of(kCorners + "part = \"walls\""),
        "s.toml:24: sensors.task.part: picks faces of objects. Needed: \"object\", the name of one, or a "
        "list of names, or \"room\", a point in one.");
    EXPECT_EQ(refusal_of("object = []"),
              "s.toml:22: sensors.task.object: found no object. Allowed: the name of an object, or a list of "
              "names.");
}

std::string plane(const std::string& keys) {
    return R"([materials.wall]
type = "diffuse"
reflectance = 0.5
[objects.room]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "wall"
[sensors.plane]
type = "plane"
)" + keys;
}
/// A second room.
const std::string kHall = R"(
[objects.hall]
shape = "box"
min = [10, 0, 1]
max = [18, 6, 5]
material = "wall"
)";

TEST(ScenePlanes, FindTheirRooms) {
    const SceneFile both =
        read_scene_text(plane("height = 0.8\nmargin = 1\nspacing = 1\nrequire = { mean = 300 }") + kHall);
    ASSERT_EQ(both.sensors.size(), 2U);
    EXPECT_EQ(both.sensors[0].name, "plane_1");
    EXPECT_EQ(both.sensors[1].name, "plane_2");
    EXPECT_EQ(both.sensors[0].size(), 2U);
    EXPECT_EQ(both.sensors[1].size(), 24U);
    EXPECT_NEAR(viewpoint_of(both.sensors[1].measurand(0)).position.z, 1.8, 1e-4);
    EXPECT_EQ(both.sensors[1].requirements.size(), 1U);
    const SceneFile one = read_scene_text(plane("object = \"hall\"") + kHall);
    ASSERT_EQ(one.sensors.size(), 1U);
    EXPECT_EQ(one.sensors[0].name, "plane");
    // Sensors that use several planes are resolved.
    const SceneFile derived = read_scene_text(
        plane("") + kHall + "[sensors.ratio]\ntype = \"derived\"\nvalue = \"plane_1.mean / plane_2.mean\"\n");
    EXPECT_EQ(derived.sensors.size(), 3U);
}

TEST(ScenePlanes, LieOverAPolygonOfAFloor) {
    const SceneFile file = read_scene_text(
        plane("polygon = [[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0]]\nmargin = 0.5\nspacing = \"auto\""));
    ASSERT_EQ(file.sensors.size(), 1U);
    EXPECT_NEAR(viewpoint_of(file.sensors[0].measurand(0)).position.z, 0.75, 1e-4);
}

TEST(ScenePlanes, MessagesSayWhatIsNeeded) {
    const auto expect = [](const std::string& keys, const std::string& part) {
        EXPECT_NE(refusal(plane(keys)).find(part), std::string::npos) << refusal(plane(keys));
    };
    expect("margin = 2", "found no floor of a room with a place for a point 2 m away from its walls");
    expect("object = \"room\"\npolygon = [[0, 0, 0], [1, 0, 0], [1, 1, 0]]", "polygon");
    expect("polygon = [[0, 0, 0], [1, 0, 0], [1, 1, 0.1]]", "another height");
    expect("polygon = [[0, 0, 0], [1, 0, 0]]", "too few corners");
    expect("object = \"rom\"", "room");
    expect("heigth = 1", "height");
}

}  // namespace
}  // namespace stilb::io
