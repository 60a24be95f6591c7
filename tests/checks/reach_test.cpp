#include <gtest/gtest.h>

#include "../support/scene_builder.h"
#include "checks/checks.h"
#include "materials/dielectric.h"
#include "materials/thin_dielectric.h"

namespace stilb::checks {
namespace {

using Texts = std::vector<std::string>;
constexpr Box kRoom{{0, 0, 0}, {4, 3, 2.8}};
const Rgb kIntensity = Rgb::grey(100);

/// A room of six rectangles, which enclose nothing by themselves: its ceiling is object 5.
Scene room_of_rectangles() {
    Scene scene;
    for (std::size_t i = 0; i < 6; ++i)
        add_object(scene, wall(kRoom, i / 2, i % 2 == 0 ? Side::low : Side::high), diffuse(0.5));
    return scene;
}

Sensor named(const std::string& name, const Vec3& position, const Vec3& normal = {0, 0, 1}) {
    return {name, IlluminancePoints{{{position, normal}}}};
}

Texts warnings_of_reach(const Scene& scene, const std::vector<Sensor>& sensors) {
    const rays::RayCaster caster(scene);
    return reach_warnings(scene, caster, sensors, Explained(scene, sensors));
}

const Sensor kReachedDesk = named("desk", {2, 1, 0.75});

TEST(Reach, LampsInTheRoomReachItsSensors) {
    Scene scene = room_of_rectangles();
    add_point_light(scene, {2, 1.5, 2.7}, kIntensity);
    add_area_light(scene, Rectangle{{1, 1, 2.79}, {0, 0.5, 0}, {0.5, 0, 0}}, Rgb::grey(100));
    EXPECT_EQ(warnings_of_reach(scene, {kReachedDesk}), Texts{});
    EXPECT_EQ(warnings_of_reach(scene, {}), Texts{});
}

TEST(Reach, AllLampsAboveTheCeiling) {
    Scene scene = room_of_rectangles();
    for (const double x : {1.0, 2.0, 3.0}) add_point_light(scene, {x, 1.5, 3}, kIntensity);
    EXPECT_EQ(warnings_of_reach(scene, {kReachedDesk}),
              Texts{"no light reaches any sensor: object \"5\" is in the way."});
}

TEST(Reach, OneLampAboveTheCeiling) {
    Scene scene = room_of_rectangles();
    for (const double z : {2.7, 3.0}) add_point_light(scene, {2, 1.5, z}, kIntensity);
    const Sensor camera{"view", Camera{.position = {0.5, 0.5, 1.5}, .target = {3, 2, 1}}};
    const Sensor sight{"sight", Luminance{{LineOfSight{{2, 2, 1}, {0, 0, -1}}}}};
    const Sensor body{"head", Spherical{{{2, 2, 1}}}};
    for (const Sensor& sensor : {kReachedDesk, camera, sight, body}) {
        const std::string what = sensor.camera() ? "what the camera sees" : "a sensor";
        EXPECT_EQ(warnings_of_reach(scene, {sensor}),
                  Texts{"light \"1\": none of its light reaches " + what + ": object \"5\" is in the way."});
    }
}

/// A front that shines out of the scene, with sensors and without.
TEST(Reach, ALampThatShinesPastEverything) {
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, diffuse(0.5));
    add_point_light(scene, {2, 1.5, 2}, kIntensity);
    add_area_light(scene, Rectangle{{1, 1, 2.5}, {0.5, 0, 0}, {0, 0.5, 0}}, Rgb::grey(100));
    EXPECT_EQ(warnings_of_reach(scene, {kReachedDesk}),
              Texts{"light \"1\": none of its light reaches a sensor: it meets no surface. "
                    "Turn it towards the scene."});
    EXPECT_EQ(warnings_of_reach(scene, {}),
              Texts{"light \"1\": none of its light meets a surface. Turn it towards the scene."});
    add_environment(scene, Rgb::grey(100));
    EXPECT_EQ(warnings_of_reach(scene, {}).size(), 1u);
}

TEST(Reach, ManyDarkLampsAreOneSentence) {
    Scene scene = room_of_rectangles();
    add_point_light(scene, {2, 1.5, 2.7}, kIntensity);
    for (int i = 0; i < 30; ++i) add_point_light(scene, {0.1 + 0.1 * i, 1.5, 3}, kIntensity);
    EXPECT_EQ(
        warnings_of_reach(scene, {kReachedDesk}),
        Texts{"lights \"1\", \"2\", \"3\" and 27 more: none of their light reaches a sensor: object \"5\" is "
              "in the way."});
}

TEST(Reach, ReflectedLightCounts) {
    Scene scene = room_of_rectangles();
    // An uplight that no point of the desk sees, and a lamp in the next room with a hole of 10 cm between.
    add_area_light(scene, Rectangle{{1, 1, 2}, {0.5, 0, 0}, {0, 0.5, 0}}, Rgb::grey(100));
    EXPECT_EQ(warnings_of_reach(scene, {kReachedDesk}), Texts{});
    scene.lights.clear();
    for (const auto& [y, height] : {std::pair{0.0, 2.8}, {1.5, 2.8}, {1.6, 2.8}}) {
        const double depth = y == 0.0 ? 1.5 : y == 1.5 ? 0.1 : 1.4, from = y == 1.5 ? 0.1 : 0.0;
        add_object(scene, Rectangle{{2, y, from}, {0, depth, 0}, {0, 0, height - from}}, diffuse(0.5));
    }
    add_point_light(scene, {3.5, 0.5, 2}, kIntensity);
    EXPECT_EQ(warnings_of_reach(scene, {named("other room", {0.5, 2.5, 0.75})}), Texts{});
}

TEST(Reach, LightComesThroughPanesAndGlass) {
    for (const Material& material : {Material{ThinDielectric{1.52, 1}}, Material{Dielectric{1.5}}}) {
        Scene scene = room_of_rectangles();
        scene.materials[5] = {"glass", material};
        add_point_light(scene, {2, 1.5, 3}, kIntensity);
        EXPECT_EQ(warnings_of_reach(scene, {kReachedDesk}), Texts{});
        scene.lights.clear();
        add_environment(scene, Rgb::grey(100));
        EXPECT_EQ(warnings_of_reach(scene, {kReachedDesk}), Texts{});
    }
}

TEST(Reach, AnEnvironmentShinesThroughASmallWindow) {
    Scene scene = room_of_rectangles();
    add_environment(scene, Rgb::grey(100));
    EXPECT_EQ(warnings_of_reach(scene, {kReachedDesk}).size(), 1u);
    scene.objects[5].shape = Rectangle{{0, 0, 2.8}, {0, 3, 0}, {3.5, 0, 0}};
    EXPECT_EQ(warnings_of_reach(scene, {kReachedDesk}), Texts{});
}

TEST(Reach, SensorsInTheDarkAreNamed) {
    Scene scene = room_of_rectangles();
    add_point_light(scene, {2, 1.5, 2.7}, kIntensity);
    const Texts warnings = warnings_of_reach(scene, {kReachedDesk, named("cellar", {2, 1, 0}, {0, 0, -1})});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("sensor \"cellar\": no light reaches it."), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace stilb::checks
