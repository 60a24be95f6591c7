#include <gtest/gtest.h>

#include "checks/checks.h"

namespace stilb::checks {
namespace {

constexpr MaterialId kWall{0}, kWood{1};

Scene room_with(const std::vector<Object>& objects) {
    Scene scene;
    scene.materials = {{"wall", Diffuse{Rgb::grey(0.5)}}, {"wood", Diffuse{Rgb::grey(0.3)}}};
    scene.objects.push_back({"room", Box{{0, 0, 0}, {4, 4, 3}}, {kWall}});
    scene.objects.insert(scene.objects.end(), objects.begin(), objects.end());
    scene.lights.push_back({"bulb", PointLight{{3, 3, 2.5}, Rgb::grey(100)}});
    return scene;
}

std::vector<std::string> warnings_of(const Scene& scene) {
    const rays::RayCaster caster(scene);
    return overlap_warnings(scene, caster, Enclosures(scene, caster));
}

Rectangle on_floor(double size) { return {{1, 1, 0}, {size, 0, 0}, {0, size, 0}}; }

TEST(Overlaps, ARugInTheFloor) {
    const auto warnings = warnings_of(room_with({{"rug", on_floor(1), {kWood}}}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("objects \"room\" and \"rug\" overlap in one plane"), std::string::npos)
        << warnings[0];
}

TEST(Overlaps, TheSharedPlaceIsNamed) {
    const auto overlaps = find_overlaps(room_with({{"rug", on_floor(1), {kWood}}}));
    ASSERT_FALSE(overlaps.empty());
    for (const Overlap& overlap : overlaps) {
        EXPECT_EQ(overlap.position.z, 0);
        EXPECT_GT(std::min(overlap.position.x, overlap.position.y), 1);
        EXPECT_LT(std::max(overlap.position.x, overlap.position.y), 2);
        EXPECT_EQ(overlap.normal, (Vec3{0, 0, 1}));
    }
}

TEST(Overlaps, EqualTrianglesInASlantedPlane) {
    const Rectangle slanted{{1, 1, 1}, {0.3, 0.4, 0.5}, {-0.2, 0.7, 0.1}};
    const auto overlaps = find_overlaps(room_with({{"a", slanted, {kWall}}, {"b", slanted, {kWood}}}));
    EXPECT_EQ(overlaps.size(), 2u);
}

TEST(Overlaps, NoWarningWhereBothLookAlike) {
    EXPECT_TRUE(warnings_of(room_with({{"rug", on_floor(1), {kWall}}})).empty());
}

TEST(Overlaps, EmittersNeverLookLikeOthers) {
    Scene scene = room_with({{"tile", on_floor(1), {kWall}}});
    scene.lights.push_back({"tile", AreaLight{ObjectId{1}, Rgb::grey(10)}});
    EXPECT_EQ(warnings_of(scene).size(), 1u);
}

TEST(Overlaps, ACabinetMayStandOnTheFloor) {
    EXPECT_TRUE(warnings_of(room_with({{"cabinet", Box{{1, 1, 0}, {2, 2, 2}}, {kWood}}})).empty());
}

TEST(Overlaps, NeighboursAndParallelsDoNotOverlap) {
    const Rectangle left{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}}, right{{2, 1, 1}, {1, 0, 0}, {0, 1, 0}};
    const Rectangle above{{1, 1, 1.001}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_TRUE(find_overlaps(room_with({{"a", left, {kWood}}, {"b", right, {kWall}}, {"c", above, {kWall}}}))
                    .empty());
}

}  // namespace
}  // namespace stilb::checks
