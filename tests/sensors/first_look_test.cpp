#include "sensors/first_look.h"

#include <gtest/gtest.h>

#include "support/prisms.h"
#include "support/scene_builder.h"

namespace stilb::sensors {
namespace {

Camera camera_of(const Scene& scene) {
    return std::get<Camera>(camera_for_first_look(scene, rays::RayCaster(scene)).kind);
}

TEST(FirstLook, StandsInTheLargestRoom) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 2.5}}, diffuse(0.5));
    add_object(scene, Box{{5, 0, 3}, {15, 8, 6}}, diffuse(0.5));
    const Camera camera = camera_of(scene);
    EXPECT_GT(camera.position.x, 5);
    EXPECT_LT(camera.position.x, 15);
    EXPECT_NEAR(camera.position.z, 4.6, 1e-4);
    EXPECT_LT(squared_length(camera.target - Vec3{10, 4, 4}), 1e-6);
    // In a corner.
    EXPECT_NEAR(std::abs(camera.position.x - 10), 4.6, 1e-3);
    EXPECT_NEAR(std::abs(camera.position.y - 4), 3.6, 1e-3);
}

TEST(FirstLook, LooksAtBodiesFromOutside) {
    Scene scene;
    add_object(scene, Sphere{{1, 2, 3}, 0.5}, diffuse(0.5));
    const Camera camera = camera_of(scene);
    EXPECT_EQ(camera.target, (Vec3{1, 2, 3}));
    // All of the sphere is in the picture, which is less high than wide.
    const double angle = std::asin(0.5 / length(camera.position - camera.target));
    EXPECT_LT(std::tan(angle), std::tan(camera.fov_deg / 2 * kPi / 180) * 480 / 720);
}

TEST(FirstLook, AllCornersAreInThePictureFromOutside) {
    // Too narrow or too low for rooms.
    for (const Vec3& size : {Vec3{1, 1, 1}, Vec3{0.7, 0.7, 30}, Vec3{40, 1, 1}, Vec3{1, 50, 0.1}}) {
        Scene scene;
        add_object(scene, Box{{0, 0, 0}, size}, diffuse(0.5));
        const Camera camera = camera_of(scene);
        const CameraView view(camera);
        const double half_width = std::tan(camera.fov_deg / 2 * kPi / 180);
        double farthest = 0;  // 1 at the picture's edge
        for (const double x : {0., size.x})
            for (const double y : {0., size.y})
                for (const double z : {0., size.z}) {
                    const Vec3 d = Vec3{x, y, z} - camera.position;
                    const double depth = dot(d, view.forward());
                    ASSERT_GT(depth, 0);
                    farthest = std::max({farthest, std::abs(dot(d, view.right())) / depth / half_width,
                                         std::abs(dot(d, view.up())) / depth / half_width * 720 / 480});
                }
        EXPECT_LT(farthest, 1);
        EXPECT_GT(farthest, 0.8);
    }
}

TEST(FirstLook, TheHeadlightIsTheOnlyLamp) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 2.5}}, diffuse(0.5));
    add_point_light(scene, {1, 1, 2}, Rgb::grey(100));
    const Camera camera = camera_of(scene);
    const Scene lit = with_headlight(scene, camera);
    ASSERT_EQ(lit.lights.size(), 1u);
    const auto& bulb = std::get<PointLight>(lit.lights[0].source);
    EXPECT_EQ(bulb.position, camera.position);
    EXPECT_NEAR(bulb.intensity_cd.luminance() / squared_length(camera.target - camera.position), 500, 1e-9);
}

TEST(FirstLook, EachRoomHasABulb) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 2.5}}, diffuse(0.5));
    add_object(scene, Box{{5, 0, 3}, {15, 8, 6}}, diffuse(0.5));
    const std::vector<Light> lights = lights_for_first_look(scene, rays::RayCaster(scene));
    ASSERT_EQ(lights.size(), 4u);
    EXPECT_LT(length(std::get<PointLight>(lights[0].source).position - Vec3{10, 4, 4.6}), 1e-3);
    EXPECT_LT(length(std::get<PointLight>(lights[1].source).position - Vec3{1.5, 1.5, 1.6}), 1e-3);
    EXPECT_EQ(lights[0].group, lights[1].group);
    EXPECT_GT(std::get<PointLight>(lights[2].source).position.z, 6);
    EXPECT_GT(std::get<EnvironmentLight>(lights[3].source).luminance_cd_m2.luminance(), 0);
    EXPECT_EQ(lights[2].group, lights[3].group);
}

TEST(FirstLook, TheBulbOfAnAngledRoomIsInIt) {
    // The middle of this L is outside of it.
    const std::vector<std::pair<double, double>> outline{{0, 0}, {12, 0}, {12, 2}, {2, 2}, {2, 12}, {0, 12}};
    Mesh room = prism(outline, {{3, 4, 5}, {3, 5, 0}, {3, 0, 1}, {3, 1, 2}});
    for (Vec3& vertex : room.vertices) vertex.z *= 2.8;
    Scene scene;
    add_object(scene, room, diffuse(0.5));
    const std::vector<Light> lights = lights_for_first_look(scene, rays::RayCaster(scene));
    ASSERT_EQ(lights.size(), 3u);
    const Vec3& at = std::get<PointLight>(lights[0].source).position;
    EXPECT_TRUE(std::min(at.x, at.y) > 0.3 && std::min(at.x, at.y) < 1.7 && std::max(at.x, at.y) < 11.7)
        << at.x << " " << at.y;
    EXPECT_NEAR(at.z, 1.6, 1e-3);
}

TEST(FirstLook, WithoutRoomsThereAreABulbAndASky) {
    Scene scene;
    add_object(scene, Sphere{{1, 2, 3}, 0.5}, diffuse(0.5));
    const rays::RayCaster caster(scene);
    const std::vector<Light> lights = lights_for_first_look(scene, caster);
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(std::get<PointLight>(lights[0].source).position,
              std::get<Camera>(camera_for_first_look(scene, caster).kind).position);
}

}  // namespace
}  // namespace stilb::sensors
