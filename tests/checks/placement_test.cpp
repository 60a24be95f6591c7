#include <gtest/gtest.h>

#include "checks/checks.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "scene/overlaps.h"

namespace stilb::checks {
namespace {

using Texts = std::vector<std::string>;

PointLight bulb(const Vec3& position) { return {position, Rgb::grey(100)}; }

/// A room of 4 m x 4 m x 3 m with a bulb, and a cabinet that stands on the floor in its corner.
Scene room_with_furniture() {
    Scene scene;
    scene.materials.push_back({"wall", Diffuse{Rgb::grey(0.5)}});
    scene.objects.push_back({"room", Box{{0, 0, 0}, {4, 4, 3}}, {MaterialId{0}}});
    scene.objects.push_back({"cabinet", Box{{0, 0, 0}, {1, 1, 2}}, {MaterialId{0}}});
    scene.lights.push_back({"bulb", bulb({3, 3, 2.5})});
    return scene;
}

Sensor at(const Vec3& position, const Vec3& normal = {0, 0, 1}) {
    return {"probe", IlluminancePoints{{{position, normal}}}};
}

Texts warnings_of_placement(const Scene& scene, const std::vector<Sensor>& sensors) {
    const rays::RayCaster caster(scene);
    Explained explained(scene, sensors);
    return placement_warnings(scene, caster, Enclosures(scene, caster), sensors, explained);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Placement, SensorsInTheRoomAreFine) {
    const std::vector<Sensor> sensors{at({2, 2, 0.75}),           at({2, 2, 0}),
                                      at({1, 0.5, 1}, {1, 0, 0}), at({0.5, 0.5, 2}),
                                      at({0, 3, 1}, {1, 0, 0}),   at({3, 3, 0.001}, {0, 0, -1})};
    EXPECT_EQ(warnings_of_placement(room_with_furniture(), sensors), Texts{});
}

TEST(Placement, PointsInsideACabinetAreCounted) {
    const Sensor grid{"desk", Grid{{0, 0, 0.75}, {4, 0, 0}, {0, 4, 0}, {8, 8}}};
    const Texts warnings = warnings_of_placement(room_with_furniture(), {grid});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0],
              "sensor \"desk\": 4 of 64 points lie inside object \"cabinet\", which contains no light: no "
              "light arrives, "
              "they read 0 lx. Move them to where light is, or a light to them.");
}

TEST(Placement, APointInsideTheCabinetsWallSide) {
    const Texts warnings = warnings_of_placement(room_with_furniture(), {at({0, 0.5, 1}, {1, 0, 0})});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(has(warnings[0], "inside object \"cabinet\"")) << warnings[0];
}

TEST(Placement, GlassKeepsNoLightOutOrIn) {
    Scene scene = room_with_furniture();
    scene.materials.push_back({"glass", Dielectric{1.5}});
    scene.objects.push_back({"globe", Sphere{{3, 3, 2.5}, 0.2}, {MaterialId{1}}});  // around the bulb
    scene.objects.push_back(
        {"case", Box{{1.5, 1.5, 0.5}, {2.5, 2.5, 1}}, {MaterialId{1}}});  // around a point
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75}), at({2, 2, 0})}), Texts{});
}

TEST(Placement, PointsOutsideOfTheRoom) {
    const Texts warnings = warnings_of_placement(room_with_furniture(), {at({6, 2, 1})});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(has(warnings[0], "outside object \"room\"")) << warnings[0];
}

TEST(Placement, APointBehindTheWallThatItShouldLieOn) {
    EXPECT_EQ(warnings_of_placement(room_with_furniture(), {at({4, 2, 1}, {1, 0, 0})}).size(), 1u);
    EXPECT_EQ(warnings_of_placement(room_with_furniture(), {at({4, 2, 1}, {-1, 0, 0})}).size(), 0u);
}

TEST(Placement, ThickWalls) {
    Scene scene = room_with_furniture();
    scene.objects.push_back({"facade", Box{{-0.3, -0.3, -0.3}, {4.3, 4.3, 3.3}}, {MaterialId{0}}});
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75})}).size(), 0u);
    const Texts warnings = warnings_of_placement(scene, {at({2, -0.15, 1})});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(has(warnings[0], "outside object \"room\"")) << warnings[0];
}

/// Two rooms with one wall, and a lamp under their ceilings that reaches through the wall: it lights the
/// second room as soon as a part of it is there, from less than a fifth of its radius on (kNearRim).
TEST(Placement, ALampThatReachesThroughAWall) {
    const auto lamp_at = [](double x, const Shape& lamp) {
        Scene scene;
        scene.materials.push_back({"wall", Diffuse{Rgb::grey(0.5)}});
        scene.objects.push_back({"left", Box{{0, 0, 0}, {4, 3, 2.5}}, {MaterialId{0}}});
        scene.objects.push_back({"right", Box{{4, 0, 0}, {8, 3, 2.5}}, {MaterialId{0}}});
        scene.objects.push_back(
            {"panel",
             geometry::transformed(lamp, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, 1.5, 2.4}}),
             {MaterialId{0}}});
        scene.lights.push_back({"lamp", AreaLight{ObjectId{2}, Rgb::grey(1000)}});
        return scene;
    };
    for (const Shape& lamp :
         {Shape{Disk{{}, {0, 0, -1}, 0.25}}, Shape{Rectangle{{-0.25, -0.25, 0}, {0, 0.5, 0}, {0.5, 0, 0}}}}) {
        const Sensor right = at({6, 1, 0}), left = at({1, 1, 0});
        for (const double end : {0.01, 0.0499, 0.05, 0.0501, 0.2, 0.25}) {  // beyond the wall
            const Scene scene = lamp_at(3.75 + end, lamp);
            EXPECT_EQ(warnings_of_placement(scene, {right}), Texts{}) << end;
            EXPECT_EQ(warnings_of_placement(scene, {left, right}), Texts{}) << end;
        }
        EXPECT_EQ(warnings_of_placement(lamp_at(3.74, lamp), {right}).size(), 1u);
        EXPECT_EQ(warnings_of_placement(lamp_at(3.74, lamp), {left, right}).size(), 1u);
    }
}

TEST(Placement, ALampInAClosedShade) {
    Scene scene = room_with_furniture();
    scene.objects.push_back({"shade", Sphere{{2, 2, 2}, 0.2}, {MaterialId{0}}});
    scene.lights.push_back({"lamp", bulb({2, 2, 2})});
    const Texts warnings = warnings_of_placement(scene, {at({2, 2, 0.75})});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0],
              "light \"lamp\" is inside object \"shade\": its light cannot get out to any sensor. Unless it "
              "lights another room, move it, or open the object.");
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75}), at({2.1, 2, 2})}).size(), 0u);
}

TEST(Placement, LampsOutsideOfTheRoom) {
    Scene scene = room_with_furniture();
    scene.lights.push_back({"lantern", bulb({2, 2, 3.2})});
    const std::vector<Sensor> sensors{at({2, 2, 0.75}), at({3, 1, 0})};
    EXPECT_EQ(
        warnings_of_placement(scene, sensors),
        Texts{"light \"lantern\" is not inside object \"room\", which encloses all sensors: its light cannot "
              "get in. Unless it lights another room, move it inside, or open the object."});
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75}), at({6, 2, 1})}), Texts{})
        << "a sensor outside, too";
    for (int i = 0; i < 8; ++i) scene.lights.push_back({"string", bulb({2.0 + i, 2, 3.2})});
    EXPECT_EQ(
        warnings_of_placement(scene, sensors),
        Texts{"lights \"lantern\", \"string\", \"string\" and 6 more are not inside object \"room\", which "
              "encloses all sensors: their light cannot get in. Unless they light another room, move them "
              "inside, or open the object."});
    const Sensor camera{"view", Camera{.position = {2, 2, 1}, .target = {3, 2, 1}}};
    scene.lights.resize(2);
    EXPECT_EQ(warnings_of_placement(scene, {camera}),
              Texts{"light \"lantern\" is not inside object \"room\", which encloses the camera: its light "
                    "cannot get in. Unless it lights another room, move it inside, or open the object."});
}

/// Whichever side a bulb in the ceiling's own plane is on, its light counts if a sensor gets it: also that of
/// the last of many lights.
TEST(Placement, ABulbThatASensorSeesIsInside) {
    Scene scene = room_with_furniture();
    for (int i = 0; i < 10; ++i) scene.lights.push_back({"bulb", bulb({2, 2, 2.5})});
    scene.lights.push_back({"in the window", bulb({2, 4.001, 1})});
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75})}).size(), 1u);
    Mesh open = triangulated(Box{{0, 0, 0}, {4, 4, 3}});
    open.triangles.erase(open.triangles.begin());
    scene.objects[0].shape = open;
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75})}).size(), 0u);
}

/// Lamps in the plane of the ceiling shine into the room, unless they are turned round.
TEST(Placement, LampsThatAreTurnedRound) {
    const auto add_spot = [](Scene& scene, const Vec3& aim) {
        const lights::LuminaireFrame frame = lights::aim_luminaire(aim, 0);
        scene.solids = {
            {.file = "spot.ies",
             .luminaire = "",
             .solid = PhotometricSolid({lights::PhotometryType::C, {0}, {0, 45, 90}, {100, 70, 0}})}};
        scene.lights.push_back(
            {"spot", Luminaire{{2, 2, 3}, SolidId{0}, frame.c0, frame.c90, frame.nadir, Rgb::grey(1)}});
    };
    const auto add_panel = [](Scene& scene, const Vec3& u, const Vec3& v) {
        scene.objects.push_back({"panel", Rectangle{{2, 1, 3}, u, v}, {MaterialId{0}}});
        scene.lights.push_back({"panel", AreaLight{ObjectId{2}, Rgb::grey(100)}});
        scene::put_lamps_in_front(scene);
    };
    const Vec3 x{0.6, 0, 0}, y{0, 0.6, 0};
    Scene good = room_with_furniture(), wrong = room_with_furniture();
    add_spot(good, {0, 0, -1}), add_panel(good, y, x);
    EXPECT_EQ(warnings_of_placement(good, {at({2, 2, 0.75})}), Texts{});
    add_spot(wrong, {0, 0, 1}), add_panel(wrong, x, y);
    const Texts expected{
        "lights \"spot\", \"panel\" are mounted in object \"room\" and turned round: their light leaves on "
        "the side "
        "without sensors. Turn them to the other side, by aim or (a rectangle) by exchanging edge_u and "
        "edge_v."};
    EXPECT_EQ(warnings_of_placement(wrong, {at({2, 2, 0.75})}), expected);
    wrong.lights.erase(
        wrong.lights.begin());  // the bulb: now all lamps are turned round, and the sensor is right
    EXPECT_EQ(warnings_of_placement(wrong, {at({2, 2, 0.75})}), expected);
}

TEST(Placement, AnEnvironmentIsOutsideOfClosedRooms) {
    Scene scene = room_with_furniture();
    scene.lights.push_back({"sky", EnvironmentLight{Rgb::grey(1000)}});
    const Texts warnings = warnings_of_placement(scene, {at({2, 2, 0.75})});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0],
              "light \"sky\" surrounds the scene, but closed surfaces enclose all sensors: its light "
              "cannot get in. Open a window, or remove the light.");
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75}), at({6, 2, 1})}).size(), 0u);
    scene.lights.erase(scene.lights.begin());
    const Texts without_bulb = warnings_of_placement(scene, {at({2, 2, 0.75})});
    ASSERT_EQ(without_bulb.size(), 1u);
    EXPECT_TRUE(has(without_bulb[0], "inside object \"room\", which contains no light")) << without_bulb[0];
    // A room with a hole keeps no light out.
    Mesh open = triangulated(Box{{0, 0, 0}, {4, 4, 3}});
    open.triangles.erase(open.triangles.begin());
    scene.objects[0].shape = open;
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75})}).size(), 0u);
    EXPECT_EQ(warnings_of_placement(scene, {at({0.5, 0.5, 0.75})}).size(), 1u) << "in the cabinet";
}

TEST(Placement, LightsOfSurfaces) {
    Scene scene = room_with_furniture();
    scene.lights.clear();
    scene.objects.push_back({"panel", Rectangle{{2, 2, 2.9}, {0, 1, 0}, {1, 0, 0}}, {MaterialId{0}}});
    scene.objects.push_back({"globe", Sphere{{3, 3, 2}, 0.1}, {MaterialId{0}}});
    scene.lights.push_back({"panel", AreaLight{ObjectId{2}, Rgb::grey(1000)}});
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75})}).size(), 0u);
    EXPECT_EQ(warnings_of_placement(scene, {at({3, 3, 2})}).size(), 1u);
    scene.lights.push_back({"globe", AreaLight{ObjectId{3}, Rgb::grey(1000)}});
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75})}).size(), 0u);
    EXPECT_EQ(warnings_of_placement(scene, {at({3, 3, 2})}).size(), 1u);  // the globe shines outwards
}

TEST(Placement, OpenSurfacesKeepNoLightOut) {
    Scene scene = room_with_furniture();
    Mesh open = triangulated(Box{{2, 2, 0}, {3, 3, 1}});
    open.triangles.erase(open.triangles.begin());
    scene.objects.push_back({"crate", open, {MaterialId{0}}});
    EXPECT_EQ(warnings_of_placement(scene, {at({2.5, 2.5, 0.5})}).size(), 0u);
}

TEST(Placement, AMeshOfSeveralClosedParts) {
    Scene scene = room_with_furniture();
    Mesh mesh = triangulated(Box{{0, 0, 0}, {4, 4, 3}});
    const Mesh cabinet = triangulated(Box{{0.1, 0.1, 0.1}, {1, 1, 2}});
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), cabinet.vertices.begin(), cabinet.vertices.end());
    for (const auto& [a, b, c] : cabinet.triangles)
        mesh.triangles.push_back({a + first, b + first, c + first});
    scene.objects = {{"office", mesh, {MaterialId{0}}}};
    EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 0.75})}).size(), 0u);
    EXPECT_EQ(warnings_of_placement(scene, {at({0.5, 0.5, 0.75})}).size(), 1u);
}

TEST(Placement, LinesOfSightAndCamerasInTheDark) {
    const Sensor sight{"sight", Luminance{{LineOfSight{{0.5, 0.5, 1}, {1, 0, 0}}}}};
    Sensor camera{"view", Camera{.position = {0.5, 0.5, 1}, .target = {3, 3, 1}}};
    const Texts warnings = warnings_of_placement(room_with_furniture(), {sight, camera});
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_TRUE(has(warnings[0], "sensor \"sight\": it lies inside object \"cabinet\"")) << warnings[0];
    EXPECT_TRUE(has(warnings[0], "it reads 0 cd/m2")) << warnings[0];
    EXPECT_TRUE(has(warnings[1], "sensor \"view\": it lies inside object \"cabinet\"")) << warnings[1];
    std::get<Camera>(camera.kind).position = {2, 2, 1};
    EXPECT_EQ(warnings_of_placement(room_with_furniture(), {camera}), Texts{});
}

TEST(Placement, GoniometersMeasureOnTheSideOfTheirNormal) {
    const auto goniometer = [](const Vec3& normal) {
        return Sensor{"probe", Goniometer{{4, 2, 1}, normal, 0.0, 90}};
    };
    EXPECT_EQ(warnings_of_placement(room_with_furniture(), {goniometer({-1, 0, 0})}).size(), 0u);
    EXPECT_EQ(warnings_of_placement(room_with_furniture(), {goniometer({1, 0, 0})}).size(), 1u);
}

TEST(Placement, NoLightNoWarning) {
    Scene scene = room_with_furniture();
    scene.lights.clear();
    EXPECT_EQ(warnings_of_placement(scene, {at({0.5, 0.5, 1})}).size(), 0u);
}

TEST(Placement, BodiesStandFree) {
    const Sensor free{"people", Cylindrical{{{2, 2, 1.2}, {3, 2, 1.6}}}};
    EXPECT_EQ(warnings_of_placement(room_with_furniture(), {free}), Texts{});
    const Sensor some{"people", Cylindrical{{{2, 2, 1.2}, {3, 2, 0}}}}, one{"globe", Spherical{{{3, 2, 0}}}};
    const Texts warnings = warnings_of_placement(room_with_furniture(), {some, one});
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(
        warnings[0],
        "sensor \"people\": 1 of 2 points lie on a surface, which hides half of the surroundings from a "
        "sensor of type cylindrical. Move it off the surface, or measure illuminance with a normal.");
    EXPECT_TRUE(has(warnings[1], "sensor \"globe\": it lies on a surface")) << warnings[1];
}

TEST(Placement, BodiesInTheDarkAreNamed) {
    const Sensor dark{"people", Cylindrical{{{0.5, 0.5, 1}}}};
    const Texts warnings = warnings_of_placement(room_with_furniture(), {dark});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(has(warnings[0], "sensor \"people\": it lies inside object \"cabinet\"")) << warnings[0];
}

/// Of a lamp that stands half in the wall, some starts of its rays lie outside and some inside.
TEST(Placement, ALampMayStandHalfInTheWall) {
    for (const Shape& shape : {Shape(Sphere{{0, 2, 1.5}, 0.3}), Shape(Disk{{0, 2, 2}, {0, 0, -1}, 0.5}),
                               Shape(Rectangle{{-0.5, 2, 2}, {0, 1, 0}, {1, 0, 0}}),
                               Shape(triangulated(Box{{-1, 2, 1}, {1, 2.1, 1.1}}))}) {
        Scene scene = room_with_furniture();
        scene.lights.clear();
        scene.objects.push_back({"lamp", shape, {MaterialId{0}}});
        scene.lights.push_back({"lamp", AreaLight{ObjectId{2}, Rgb::grey(1000)}});
        EXPECT_EQ(warnings_of_placement(scene, {at({2, 2, 1.5}, {-1, 0, 0}), at({1.5, 2, 0.5})}), Texts{});
    }
}

/// Walls of buildings stand on slabs and under ceilings, whose layers touch. A partition parts the lamp from
/// most points, but for a passage, so that rays must tell where these are.
TEST(Placement, PartsOfABuildingThatTouchEncloseThemselvesAlone) {
    Scene scene;
    scene.materials.push_back({"wall", Diffuse{Rgb::grey(0.5)}});
    const auto add = [&](const Vec3& min, const Vec3& max) {
        scene.objects.push_back({"part", triangulated(Box{min, max}), {MaterialId{0}}});
    };
    add({0, 0, -0.2}, {8, 5, 0}), add({0, 0, -0.4}, {8, 5, -0.2});                            // slabs
    add({0, 0, 2.7}, {8, 5, 2.9}), add({3, 0, 2.9}, {8, 5, 3}), add({0, 0, 3}, {8, 4, 3.1});  // ceilings
    add({0, 0, 0}, {0.2, 5, 2.7}), add({7.8, 0, 0}, {8, 5, 2.7}), add({0.2, 0, 0}, {7.8, 0.2, 2.7});
    add({0.2, 4.8, 0}, {7.8, 5, 2.7}), add({8, 0, -0.2}, {8.1, 5, 2.9});
    add({3, 0.2, 0}, {3.1, 4, 2.7}), add({3.1, 0.2, 0}, {3.2, 4, 2.7});  // the partition's layers
    scene.lights.push_back({"bulb", bulb({1, 1, 2.5})});
    const Sensor floor{"floor", Grid{{0.3, 0.3, 0.75}, {7.4, 0, 0}, {0, 4.4, 0}, {20, 10}}};
    const Texts warnings = warnings_of_placement(scene, {floor});
    ASSERT_EQ(warnings.size(), 1u);  // a column of points stands in the partition
    EXPECT_TRUE(has(warnings[0], "8 of 200 points lie inside object \"part\"")) << warnings[0];
}

}  // namespace
}  // namespace stilb::checks
