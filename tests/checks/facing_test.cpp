#include <gtest/gtest.h>

#include "../support/scene_builder.h"
#include "checks/checks.h"
#include "materials/thin_dielectric.h"

namespace stilb::checks {
namespace {

using Texts = std::vector<std::string>;
const Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};

/// A room with a table, and a bulb.
Scene furnished_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.5));
    add_object(scene, Rectangle{{1, 1, 0.74}, {1, 0, 0}, {0, 1, 0}}, diffuse(0.5));
    add_point_light(scene, {2, 1.5, 2.5}, Rgb::grey(100));
    return scene;
}

Sensor grid_at(double z, const Vec3& normal) {
    return {"desk", Grid{{1, 1, z}, {1, 0, 0}, {0, 1, 0}, {4, 4}, normal}};
}

Texts warnings_of_facing(const Scene& scene, const std::vector<Sensor>& sensors = {}) {
    const rays::RayCaster caster(scene);
    Explained explained(scene, sensors);
    return facing_warnings(scene, caster, sensors, explained);
}

/// A panel of 60 cm; its front faces up if `is_up`.
Scene room_with_panel(double z, bool is_up, double width = 0.6) {
    Scene scene = furnished_room();
    const Vec3 u{width, 0, 0}, v{0, 0.6, 0};
    add_area_light(scene, Rectangle{{2.5, 1, z}, is_up ? u : v, is_up ? v : u}, Rgb::grey(100));
    return scene;
}

TEST(Facing, APanelThatFacesTheCeilingIsTurned) {
    const Texts warnings = warnings_of_facing(room_with_panel(2.79, true));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("light \"1\": its front faces object \"0\", 1 cm away"), std::string::npos)
        << warnings[0];
    EXPECT_EQ(warnings_of_facing(room_with_panel(2.79, false)), Texts{});
}

TEST(Facing, LightFromNarrowStripsAndFromUplightsGetsOut) {
    EXPECT_EQ(warnings_of_facing(room_with_panel(2.6, true)), Texts{});
    EXPECT_EQ(warnings_of_facing(room_with_panel(2.79, true, 0.005)), Texts{});
}

/// A luminaire of a file with light downwards only.
void add_panel(Scene& scene, const Vec3& position) {
    const PhotometricSolid solid({lights::PhotometryType::C, {0}, {0, 45, 90}, {100, 70, 0}});
    add_luminaire(scene, position, solid, kDown, 0, Rgb::grey(1));
    scene.lights.back().name = "panel";
}

/// The luminaire is 5 cm above a false ceiling.
TEST(Facing, ALuminaireAboveAFalseCeiling) {
    Scene scene = furnished_room();
    add_panel(scene, {2, 1.5, 2.65});
    EXPECT_EQ(warnings_of_facing(scene), Texts{});
    add_object(scene, Rectangle{{0, 0, 2.6}, {0, 3, 0}, {4, 0, 0}}, diffuse(0.7));
    EXPECT_EQ(
        warnings_of_facing(scene),
        Texts{
            "light \"panel\": its front faces object \"2\", 5 cm away, which stops almost all of its light. "
            "Move it to the other side, or turn its aim round."});
    for (int i = 0; i < 4; ++i) scene.lights.push_back(scene.lights[1]);
    EXPECT_EQ(
        warnings_of_facing(scene),
        Texts{
            "lights \"panel\", \"panel\", \"panel\" and 2 more: their fronts face object \"2\", 5 cm away, "
            "which stops almost all of their light. Move them to the other side, or turn their aim round."});
}

/// A luminaire this far above a false ceiling.
TEST(Facing, GapsOfTenCentimetresAreNarrow) {
    const auto warnings_at = [](double gap_m) {
        Scene scene = furnished_room();
        add_panel(scene, {2, 1.5, 2});
        add_object(scene, Rectangle{{0, 0, 2 - gap_m}, {0, 3, 0}, {4, 0, 0}}, diffuse(0.7));
        return warnings_of_facing(scene).size();
    };
    EXPECT_EQ(warnings_at(0.0999), 1u);
    EXPECT_EQ(warnings_at(0.1001), 0u);
}

TEST(Facing, AGlassCoverStopsNoLight) {
    Scene scene = room_with_panel(2.6, true);
    add_object(scene, Rectangle{{2, 0.5, 2.61}, {1.5, 0, 0}, {0, 1.5, 0}}, ThinDielectric{1.52, 1});
    EXPECT_EQ(warnings_of_facing(scene), Texts{});
}

TEST(Facing, AGridThatFacesTheTableBelowIt) {
    const Texts warnings = warnings_of_facing(furnished_room(), {grid_at(0.75, kDown)});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("sensor \"desk\": its normal points to object \"1\", 1 cm away"),
              std::string::npos)
        << warnings[0];
}

TEST(Facing, WhatIsTwoCentimetresInFrontHidesTheRest) {
    EXPECT_EQ(warnings_of_facing(furnished_room(), {grid_at(0.7599, kDown)}).size(), 1u);
    EXPECT_EQ(warnings_of_facing(furnished_room(), {grid_at(0.7601, kDown)}).size(), 0u);
}

TEST(Facing, AGridOnTheTableThatFacesDown) {
    const Texts warnings = warnings_of_facing(furnished_room(), {grid_at(0.74, kDown)});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("sensor \"desk\": it lies on object \"1\", but its normal points into it"),
              std::string::npos)
        << warnings[0];
}

TEST(Facing, UsualGridsAreFine) {
    for (const Sensor& sensor : {grid_at(0.75, kUp), grid_at(0.74, kUp), grid_at(0, kUp), grid_at(0.9, kDown),
                                 grid_at(1.6, kDown), grid_at(2.8, kDown)})
        EXPECT_EQ(warnings_of_facing(furnished_room(), {sensor}), Texts{});
}

Texts unit_warnings_of(const Mesh& mesh) {
    Scene scene;
    add_object(scene, mesh, diffuse(0.5));
    return unit_warnings(scene);
}

TEST(Units, ARoomInMillimetresOrCentimetres) {
    const Texts millimetres = unit_warnings_of(inward({{0, 0, 0}, {4000, 3000, 2500}}));
    ASSERT_EQ(millimetres.size(), 1u);
    EXPECT_NE(
        millimetres[0].find("4000 m long and 2500 m high. If the file is in millimetres, set scale = 0.001"),
        std::string::npos)
        << millimetres[0];
    const Texts centimetres = unit_warnings_of(inward({{0, 0, 0}, {400, 300, 250}}));
    ASSERT_EQ(centimetres.size(), 1u);
    EXPECT_NE(centimetres[0].find("scale = 0.01 "), std::string::npos) << centimetres[0];
    Mesh open = triangulated(Box{{0, 0, 0}, {4000, 3000, 2500}});
    std::erase_if(open.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](std::uint32_t v) { return open.vertices[v].z > 0; });
    });
    EXPECT_EQ(unit_warnings_of(open).size(), 1u) << "without a ceiling";
}

TEST(Units, HallsGroundsAndTerrainsAreInMetres) {
    EXPECT_EQ(unit_warnings_of(inward({{0, 0, 0}, {4, 3, 2.5}})), Texts{});
    EXPECT_EQ(unit_warnings_of(inward({{0, 0, 0}, {400, 300, 60}})), Texts{});
    EXPECT_EQ(unit_warnings_of(inward({{0, 0, 0}, {400, 300, 199.9}})), Texts{});
    EXPECT_EQ(unit_warnings_of(inward({{0, 0, 0}, {400, 300, 200}})).size(), 1u);
    EXPECT_EQ(unit_warnings_of(triangulated(Rectangle{{0, 0, 0}, {1000, 0, 0}, {0, 1000, 0}})), Texts{});
    EXPECT_EQ(unit_warnings_of(Mesh{{{0, 0, 0}, {5000, 0, 900}, {5000, 5000, 300}, {0, 5000, 1200}},
                                    {{0, 1, 2}, {0, 2, 3}}}),
              Texts{});
}

}  // namespace
}  // namespace stilb::checks
