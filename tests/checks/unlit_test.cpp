#include <gtest/gtest.h>

#include "checks/checks.h"
#include "materials/black.h"
#include "materials/thin_dielectric.h"

namespace stilb::checks {
namespace {

constexpr ObjectId kProbe{1};

/// A room with a bulb, and one object more.
Scene room_with(const Shape& probe) {
    Scene scene;
    scene.materials = {{"black", Black{}}};
    scene.objects.push_back({"room", Box{{0, 0, 0}, {4, 4, 3}}, {MaterialId{0}}});
    scene.objects.push_back({"probe", probe, {MaterialId{0}}});
    scene.lights.push_back({"bulb", PointLight{{3, 3, 2.5}, Rgb::grey(100)}});
    return scene;
}

std::vector<ObjectId> unlit_in(const Scene& scene) { return unlit_objects(scene, rays::RayCaster(scene)); }

TEST(Unlit, WhatStandsInTheRoomIsLit) {
    EXPECT_TRUE(unlit_in(room_with(Box{{1, 1, 0}, {2, 2, 1}})).empty());
    EXPECT_TRUE(unlit_in(room_with(Disk{{1, 1, 0.5}, {0, 0, -1}, 0.2})).empty());
}

TEST(Unlit, SmallThingsThatNoParticleHitsAreSeen) {
    EXPECT_TRUE(unlit_in(room_with(Sphere{{1, 1, 1}, 1e-4})).empty());
    EXPECT_TRUE(unlit_in(room_with(Rectangle{{1, 1, 1e-3}, {1e-4, 0, 0}, {0, 1e-4, 0}})).empty());
}

TEST(Unlit, WhatTheLightReachesOnlyByReflectionIsLit) {
    Scene scene = room_with(Sphere{{1, 1, 0.5}, 0.01});
    scene.objects.push_back({"roof", Rectangle{{0, 0, 1}, {2, 0, 0}, {0, 2, 0}}, {MaterialId{0}}});
    scene.objects.push_back({"screen", Rectangle{{2, 0, 0.2}, {0, 2, 0}, {0, 0, 0.8}}, {MaterialId{0}}});
    EXPECT_TRUE(unlit_in(scene).empty());
}

TEST(Unlit, AnEnvironmentLightsAllThatIsOutside) {
    Scene scene = room_with(Sphere{{8, 1, 1}, 1});
    scene.objects.push_back({"shut in", Sphere{{8, 1, 1}, 0.5}, {MaterialId{0}}});
    scene.lights.push_back({"sky", EnvironmentLight{Rgb::grey(1e6)}});
    EXPECT_EQ(unlit_in(scene), std::vector{ObjectId{2}});
    scene.lights.erase(scene.lights.begin());
    scene.objects.push_back({"shut in the room", Box{{1, 1, 0.1}, {2, 2, 1}}, {MaterialId{0}}});
    EXPECT_EQ(unlit_in(scene), (std::vector{ObjectId{2}, ObjectId{3}}));
}

TEST(Unlit, WhatIsOutsideOrShutInIsNot) {
    EXPECT_EQ(unlit_in(room_with(Sphere{{8, 1, 1}, 1})), std::vector{kProbe});
    Scene scene = room_with(Sphere{{1, 1, 1}, 0.1});
    scene.objects.push_back({"safe", Box{{0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}}, {MaterialId{0}}});
    EXPECT_EQ(unlit_in(scene), std::vector{kProbe});
}

TEST(Unlit, ManyDarkObjectsAreOneSentence) {
    Scene scene = room_with(Sphere{{1, 1, 1}, 0.1});
    for (int i = 0; i < 22; ++i)
        scene.objects.push_back({std::to_string(i), Sphere{{10.0 + i, 1, 1}, 0.1}, {MaterialId{0}}});
    const rays::RayCaster caster(scene);
    EXPECT_EQ(unlit_warnings(scene, caster),
              std::vector<std::string>{"objects \"0\", \"1\", \"2\" and 19 more: no light reaches them."});
}

TEST(Unlit, LightGetsThroughPanes) {
    Scene scene = room_with(Sphere{{1, 1, 1}, 0.1});
    scene.materials.push_back({"pane", ThinDielectric{1.52, 1}});
    scene.objects.push_back({"show case", Box{{0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}}, {MaterialId{1}}});
    EXPECT_TRUE(unlit_in(scene).empty());
}

TEST(Unlit, EmittersLightThemselves) {
    Scene scene = room_with(Sphere{{8, 1, 1}, 1});
    scene.lights.push_back({"globe", AreaLight{kProbe, Rgb::grey(1)}});
    EXPECT_TRUE(unlit_in(scene).empty());
}

}  // namespace
}  // namespace stilb::checks
