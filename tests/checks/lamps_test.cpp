// Warnings of lamps that were probably not meant.
#include <gtest/gtest.h>

#include "../support/scene_builder.h"
#include "checks/checks.h"
#include "scene/cut_lamps.h"

namespace stilb::checks {
namespace {

using Texts = std::vector<std::string>;

Sensor point_named(const std::string& name, const Vec3& position) {
    return {name, IlluminancePoints{{{position, {0, 0, 1}}}}};
}
const Sensor kDesk = point_named("desk", {2, 1, 0.75});

Scene room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, diffuse(0.5));
    return scene;
}

Texts warnings_of_lamps(const Scene& scene, const std::vector<Sensor>& sensors = {kDesk}) {
    const rays::RayCaster caster(scene);
    return lamp_warnings(scene, caster, Enclosures(scene, caster).components(), sensors);
}

PhotometricSolid lambertian() {
    return PhotometricSolid({lights::PhotometryType::C, {0}, {0, 30, 60, 90}, {100, 87, 50, 0}});
}

void add_luminaire_at(Scene& scene, const Vec3& position, const Vec3& aim, double spin_deg = 0,
                      const Rgb& factor = Rgb::grey(1)) {
    const lights::LuminaireFrame frame = lights::aim_luminaire(aim, spin_deg);
    if (scene.solids.empty())
        scene.solids.push_back({.file = "panel.ldt", .luminaire = "", .solid = lambertian()});
    scene.lights.push_back({std::to_string(scene.lights.size()),
                            Luminaire{position, SolidId{0}, frame.c0, frame.c90, frame.nadir, factor}});
}

TEST(Lamps, TwoAlikeInOnePlaceAreOneTooMany) {
    Scene scene = room();
    add_luminaire_at(scene, {1, 1, 2.4}, {0, 0, -1});
    add_luminaire_at(scene, {2, 1, 2.4}, {0, 0, -1});
    add_luminaire_at(scene, {1, 1, 2.4}, {0, 0, -1}, 0, Rgb::grey(0.5));
    EXPECT_EQ(warnings_of_lamps(scene),
              Texts{"lights \"0\", \"2\" are alike and in one place, (1, 1, 2.4): their light "
                    "adds up. Remove all but one."});
    add_luminaire_at(scene, {2, 1, 2.4}, {0, 0, -1});
    EXPECT_EQ(warnings_of_lamps(scene),
              Texts{"lights \"0\", \"2\" are alike and in one place, (1, 1, 2.4), and so are "
                    "lights in 1 more place: their light adds up. Remove all but one."});
}

TEST(Lamps, PointsAndSpheresToo) {
    Scene scene = room();
    for (int i = 0; i < 5; ++i) add_point_light(scene, {1, 1, 2}, Rgb::grey(100));
    EXPECT_EQ(warnings_of_lamps(scene),
              Texts{"lights \"0\", \"1\", \"2\" and 2 more are alike and in one place, (1, 1, 2): "
                    "their light adds up. Remove all but one."});
    scene.lights.clear();
    for (int i = 0; i < 2; ++i) add_area_light(scene, Sphere{{1, 1, 2}, 0.1}, Rgb::grey(100));
    EXPECT_EQ(warnings_of_lamps(scene).size(), 1u);
}

TEST(Lamps, DifferentOnesInOnePlaceAreMeantSo) {
    Scene scene = room();
    add_luminaire_at(scene, {1, 1, 2}, {0, 0, -1});
    add_luminaire_at(scene, {1, 1, 2}, {0, 0, 1});                          // up and down
    add_luminaire_at(scene, {1, 1, 2}, {0, 0, -1}, 90);                     // across
    add_luminaire_at(scene, {1, 1, 2}, {0, 0, -1}, 0, {{1.3, 0.95, 0.6}});  // another white
    add_point_light(scene, {1, 1, 2}, Rgb::grey(100));
    add_point_light(scene, {1, 1, 2.002}, Rgb::grey(100));
    EXPECT_EQ(warnings_of_lamps(scene), Texts{});
}

TEST(Lamps, AWholeClosedMeshIsSuspicious) {
    Scene scene = room();
    add_area_light(scene, triangulated(Box{{1, 1, 2}, {1.6, 1.6, 2.1}}), Rgb::grey(100));
    const std::string advice =
        ". If only some of its faces are the lamp, pick them by material or mesh_group, or make them an "
        "object of "
        "their own.";
    EXPECT_EQ(warnings_of_lamps(scene),
              Texts{"light \"0\": the whole of object \"1\" shines, 0.96 m2 of a closed surface" + advice});
    add_area_light(scene, Box{{3, 1, 2}, {3.6, 1.6, 2.1}}, Rgb::grey(100));
    EXPECT_EQ(
        warnings_of_lamps(scene),
        Texts{"light \"0\": the whole of object \"1\" shines, 0.96 m2 of a closed surface; likewise \"1\"" +
              advice});
}

TEST(Lamps, ALampAroundSensorsIsSuspicious) {
    const std::string advice =
        ". If only some of its faces are the lamp, pick them by material or mesh_group, or make them an "
        "object of "
        "their own.";
    Scene scene;
    add_area_light(scene, inward(Box{{0, 0, 0}, {4, 3, 2.5}}), Rgb::grey(100));
    EXPECT_EQ(
        warnings_of_lamps(scene, {kDesk, point_named("bed", {1, 2, 0.5}), point_named("outside", {9, 9, 9})}),
        Texts{"light \"0\": the whole of object \"0\" shines, 59 m2 of a closed surface, all around sensors "
              "\"desk\", \"bed\"" +
              advice});
    // With an open door it is no closed surface.
    auto& mesh = std::get<Mesh>(scene.objects[0].shape);
    mesh.triangles.erase(mesh.triangles.begin());
    const Texts warnings = warnings_of_lamps(scene);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(warnings[0].find(" m2, all around sensor \"desk\".") != std::string::npos) << warnings[0];
}

TEST(Lamps, UsualOnesAreFine) {
    Scene scene = room();
    add_area_light(scene, Rectangle{{1, 1, 2.49}, {0, 1, 0}, {1, 0, 0}}, Rgb::grey(100));
    add_area_light(scene, triangulated(Rectangle{{2, 1, 2.49}, {0, 1, 0}, {1, 0, 0}}), Rgb::grey(100));
    add_area_light(scene, Sphere{{3, 2, 2}, 0.1}, Rgb::grey(100));
    // A luminous ceiling, and the glass of a lamp of which the rest is metal.
    add_area_light(scene, triangulated(Rectangle{{0, 0, 2.48}, {0, 3, 0}, {4, 0, 0}}), Rgb::grey(100));
    const ObjectId lamp = add_object(scene, triangulated(Box{{1, 1, 2}, {1.6, 1.6, 2.1}}), diffuse(0.5));
    const ObjectId glass = scene::cut_out(scene, lamp, std::vector<std::uint32_t>{0, 1}, "lamp (glass)");
    scene.lights.push_back({"glass", AreaLight{glass, Rgb::grey(100)}});
    EXPECT_EQ(warnings_of_lamps(scene), Texts{});
}

// Meshes whose lamps were cut out are as closed as before.

/// A room as a mesh seen from inside, in whose ceiling two triangles are the lamp.
Scene room_with_cut_lamp() {
    Scene scene;
    const ObjectId body = add_object(scene, inward(Box{{0, 0, 0}, {4, 3, 2.5}}), diffuse(0.5));
    std::vector<std::uint32_t> ceiling;
    const auto& mesh = std::get<Mesh>(scene.objects[0].shape);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        if (mesh.vertices[a].z + mesh.vertices[b].z + mesh.vertices[c].z > 7.4) ceiling.push_back(t);
    }
    EXPECT_EQ(ceiling.size(), 2u);
    const ObjectId lamp = scene::cut_out(scene, body, ceiling, "room (lamp)");
    scene.lights.push_back({"lamp", AreaLight{lamp, Rgb::grey(100)}});
    return scene;
}

TEST(CutLamps, CloseTheirMesh) {
    const Scene scene = room_with_cut_lamp();
    const rays::RayCaster caster(scene);
    const Enclosures enclosures(scene, caster);
    EXPECT_EQ(enclosures.components()[0].total_open_edges(), 0u);
    EXPECT_EQ(enclosures.components()[1].total_open_edges(), 4u);
    const std::vector<Sensor> inside{kDesk};
    EXPECT_TRUE(scene_warnings(scene, caster, enclosures, inside).empty());
    const std::vector<Sensor> outside{point_named("street", {9, 1, 1})};
    const Texts warnings = texts_of(scene_warnings(scene, caster, enclosures, outside));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("sensor \"street\": it lies outside object \"0\""), std::string::npos)
        << warnings[0];
}

/// A hole beside the lamp is still found: a ball of which one triangle is missing and another one shines.
TEST(CutLamps, DoNotHideOtherHoles) {
    Mesh ball = icosphere({{2, 1, 1}, 0.5}, 3);
    ball.triangles.erase(ball.triangles.begin() + 40);
    Scene scene = room();
    const ObjectId body = add_object(scene, ball, diffuse(0.5));
    scene::cut_out(scene, body, std::vector<std::uint32_t>{100}, "ball (lamp)");
    const rays::RayCaster caster(scene);
    const Texts warnings = SceneFindings(scene).holes;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("it nearly closes, except for 3 open edges"), std::string::npos)
        << warnings[0];
}

/// A lamp beside the mesh, which no edge connects with it, leaves it closed; and the lamp as open as it is.
TEST(CutLamps, MayBeComponentsOfTheirOwn) {
    Scene scene = room();
    Mesh mesh = triangulated(Box{{1, 1, 2}, {1.6, 1.6, 2.1}});
    mesh.vertices.insert(mesh.vertices.end(), {{1, 1, 1.9}, {1, 1.5, 1.9}, {1.5, 1, 1.9}});
    mesh.triangles.push_back({8, 9, 10});
    const ObjectId body = add_object(scene, mesh, diffuse(0.5));
    scene::cut_out(scene, body, std::vector<std::uint32_t>{12}, "lamp (sheet)");
    const rays::RayCaster caster(scene);
    const Enclosures enclosures(scene, caster);
    EXPECT_EQ(enclosures.components()[1].count(), 1u);
    EXPECT_EQ(enclosures.components()[1].total_open_edges(), 0u);
    EXPECT_EQ(enclosures.components()[2].total_open_edges(), 3u);
}

TEST(Lamps, AreasInOnePlaceAddUp) {
    Scene scene = room();
    const Rectangle panel{{1, 1, 2}, {0, 1, 0}, {1, 0, 0}};
    add_area_light(scene, panel, Rgb::grey(100));
    add_area_light(scene, panel, Rgb::grey(300));
    EXPECT_EQ(warnings_of_lamps(scene),
              Texts{"lights \"0\", \"1\" are alike and in one place, (1.5, 1.5, 2): their "
                    "light adds up. Remove all but one."});
    const rays::RayCaster caster(scene);
    EXPECT_EQ(overlap_warnings(scene, caster, SceneFindings(scene).overlaps, {}), Texts{})
        << "one warning for one mistake";
    Scene back_to_back = room();
    add_area_light(back_to_back, panel, Rgb::grey(100));
    add_area_light(back_to_back, Rectangle{panel.corner, panel.edge_v, panel.edge_u}, Rgb::grey(100));
    EXPECT_EQ(warnings_of_lamps(back_to_back), Texts{});
}

}  // namespace
}  // namespace stilb::checks
