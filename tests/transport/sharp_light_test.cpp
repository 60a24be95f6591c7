#include "transport/sharp_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "materials/dielectric.h"
#include "materials/mirror.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/thin_dielectric.h"
#include "support/scene_builder.h"

namespace stilb::transport {
namespace {

/// A lamp in a room of 4 x 4 x 2.5 m, 1 m above a floor of its own.
Scene room_with_floor(const Material& floor, double lamp_radius_m = 0.005) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 2.5}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, 0, 0.01}, {4, 0, 0}, {0, 4, 0}}, floor);
    add_area_light(scene, Sphere{{2, 2, 1.01}, lamp_radius_m}, Rgb::grey(1e6));
    return scene;
}

double samples_for(const Scene& scene) {
    return static_cast<double>(find_sharp_light(scene, rays::RayCaster(scene)).samples);
}

Material metal(double roughness) {
    return RoughConductor(RoughConductor::Parameters{Rgb::grey(0.8), roughness});
}

TEST(SharpLight, IsNotFoundAmongDiffuseSurfaces) { EXPECT_EQ(samples_for(room_with_floor(diffuse(0.5))), 0); }

TEST(SharpLight, TakesMoreSamplesTheSharperItIs) {
    const double rough = samples_for(room_with_floor(metal(0.1)));
    const double smooth = samples_for(room_with_floor(metal(0.01)));
    EXPECT_GT(rough, 0);
    EXPECT_GT(smooth, 30 * rough);  // the solid angle of a lobe goes with the square of the roughness
    EXPECT_LT(samples_for(room_with_floor(metal(0.01), 0.2)), 0.2 * smooth);  // a large lamp blurs it
}

/// The weak coat reflects as sharply as the metal.
TEST(SharpLight, OfACoatIsAsSharpAsThatOfMetal) {
    const Material plastic = Plastic(Plastic::Parameters{Rgb::grey(0.3), 1.5, 0.02});
    const double of_coat = samples_for(room_with_floor(plastic)),
                 of_metal = samples_for(room_with_floor(metal(0.02)));
    EXPECT_GT(of_coat, of_metal / 8);
    EXPECT_LT(of_coat, 2 * of_metal);
}

TEST(SharpLight, PassesGlassAndPanes) {
    Scene ball = room_with_floor(diffuse(0.5), 0.02);
    add_object(ball, Sphere{{2, 2, 1.01}, 0.1}, Dielectric{1.5});
    EXPECT_GT(samples_for(ball), 1e4);
    EXPECT_EQ(index_of(find_sharp_light(ball, rays::RayCaster(ball)).object), 3U);
    Scene pane = room_with_floor(diffuse(0.5), 0.02);
    add_object(pane, Rectangle{{0, 0, 1.5}, {4, 0, 0}, {0, 4, 0}}, ThinDielectric{1.0, Rgb::grey(0.9)});
    EXPECT_EQ(samples_for(pane), 0);  // light that goes straight on is found by shadow rays
}

/// A sun of one pixel and of nine, half of the light, in a mirror on the ground.
TEST(SharpLight, OfASunInAMirrorGoesWithItsSolidAngle) {
    const auto samples_with_sun = [](int pixels) {
        Panorama::Image image{256, 128, std::vector<std::array<float, 3>>(256 * 128, {1, 1, 1})};
        for (int y = 0; y < pixels; ++y) {
            for (int x = 0; x < pixels; ++x) image.rgb_cd_m2[(32 + y) * 256 + x].fill(1e5F);
        }
        Scene scene;
        add_object(scene, Rectangle{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}}, Mirror{Rgb::grey(0.9)});
        add_object(scene, Box{{-1, -1, 1}, {1, 1, 1.1}}, diffuse(0.5));
        EnvironmentLight sky;
        sky.panorama = std::make_shared<const Panorama>(std::move(image));
        scene.lights.push_back({"sky", sky});
        return samples_for(scene);
    };
    const double pixel_sr = std::pow(2 * kPi / 256, 2) * std::sqrt(0.5);  // 45 degrees high
    const double small = samples_with_sun(1), large = samples_with_sun(3);
    EXPECT_GT(small, 40 * kPi / (2 * pixel_sr));
    EXPECT_LT(small, 40 * kPi / (0.5 * pixel_sr));
    EXPECT_NEAR(small / large, 9, 3);
}

TEST(SharpLight, OfPointsByMirrorsIsLeftOut) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 2.5}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, 0, 0.01}, {4, 0, 0}, {0, 4, 0}}, Mirror{Rgb::grey(0.9)});
    add_point_light(scene, {2, 2, 1}, Rgb::grey(100));
    EXPECT_EQ(samples_for(scene), 0);
}

}  // namespace
}  // namespace stilb::transport
