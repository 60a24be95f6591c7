// Rooms that lose next to no light.
#include <gtest/gtest.h>

#include "../support/scene_builder.h"
#include "checks/checks.h"
#include "materials/diffuse.h"

namespace stilb::checks {
namespace {

Scene room(const Rgb& reflectance) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, Diffuse{reflectance});
    add_point_light(scene, {2, 1.5, 2}, Rgb::grey(100));
    return scene;
}

std::vector<std::string> warnings_of_absorption(const Scene& scene) {
    return absorption_warnings(scene, rays::RayCaster(scene));
}
bool is_endless(const Scene& scene) { return endless_light(scene, rays::RayCaster(scene)).has_value(); }

TEST(Absorption, RoomsOfRealSurfacesAreNotNamed) {
    for (const double reflectance : {0.9, 0.99, 0.9949, 0.995}) {
        EXPECT_TRUE(warnings_of_absorption(room(Rgb::grey(reflectance))).empty()) << reflectance;
        EXPECT_FALSE(is_endless(room(Rgb::grey(reflectance))));
    }
}

TEST(Absorption, NearlyWhiteRoomsAreNamed) {
    for (const double reflectance : {0.9951, 0.9984, 0.999, 0.9999, 0.999999}) {
        const auto warnings = warnings_of_absorption(room(Rgb::grey(reflectance)));
        ASSERT_EQ(warnings.size(), 1u) << reflectance;
        EXPECT_NE(warnings[0].find("object \"0\""), std::string::npos) << warnings[0];
        EXPECT_FALSE(is_endless(room(Rgb::grey(reflectance))));
    }
    EXPECT_TRUE(
        warnings_of_absorption(room(Rgb::grey(0.999)))[0].starts_with("light is reflected about 1e+03 times"))
        << warnings_of_absorption(room(Rgb::grey(0.999)))[0];
}

/// Something white that no light meets is enough to look.
TEST(Absorption, RoomsThatLoseMoreAreNotNamed) {
    for (const double lost : {0.0149, 0.0151}) {
        Scene scene = room(Rgb::grey(1 - lost));
        add_object(scene, Rectangle{{9, 9, 9}, {1, 0, 0}, {0, 1, 0}}, diffuse(1));
        EXPECT_EQ(warnings_of_absorption(scene).size(), lost < 0.015 ? 1u : 0u) << lost;
    }
}

/// A white room with a slit along its ceiling: runs take a hundred times as long as in a grey one.
TEST(Absorption, WhiteRoomsWithANarrowOpeningAreNamed) {
    Scene scene;
    Mesh walls = triangulated(Box{{0, 0, 0}, {4, 3, 2.5}});
    std::erase_if(walls.triangles, [&](const Triangle& t) {
        return walls.vertices[t[0]].z + walls.vertices[t[1]].z + walls.vertices[t[2]].z == 7.5;
    });
    ASSERT_EQ(walls.triangles.size(), 10u);
    add_object(scene, walls, diffuse(1));
    add_object(scene, Rectangle{{0, 0, 2.5}, {0, 3, 0}, {3.9, 0, 0}}, diffuse(1));
    add_point_light(scene, {2, 1.5, 2}, Rgb::grey(100));
    const auto warnings = warnings_of_absorption(scene);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("gets out"), std::string::npos) << warnings[0];
    EXPECT_FALSE(is_endless(scene));
}

TEST(Absorption, WhiteRoomsHaveNoValue) {
    EXPECT_TRUE(is_endless(room(Rgb::grey(1))));
    EXPECT_TRUE(is_endless(room({{0.5, 1, 0.2}}))) << "in one band";
    EXPECT_NE(warnings_of_absorption(room(Rgb::grey(1)))[0].find("no finite value"), std::string::npos);
}

TEST(Absorption, LightThatGetsOutOrMeetsSomethingGreyFindsAnEnd) {
    Scene with_table = room(Rgb::grey(1));
    add_object(with_table, Rectangle{{1, 1, 0.7}, {1, 0, 0}, {0, 1, 0}}, diffuse(0.5));
    EXPECT_TRUE(warnings_of_absorption(with_table).empty());
    Scene open;
    add_object(open, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, diffuse(1));
    add_object(open, Rectangle{{0, 0, 2.5}, {0, 3, 0}, {4, 0, 0}}, diffuse(1));
    add_point_light(open, {2, 1.5, 2}, Rgb::grey(100));
    EXPECT_TRUE(warnings_of_absorption(open).empty());
    Scene dark = room(Rgb::grey(1));
    dark.lights.clear();
    EXPECT_TRUE(warnings_of_absorption(dark).empty());
}

}  // namespace
}  // namespace stilb::checks
