// Direct light at points against closed forms and against each other.
#include "walk/display/direct_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/configuration_factors.h"
#include "materials/thin_dielectric.h"
#include "support/scene_builder.h"

namespace stilb::walk {
namespace {

constexpr Rectangle kPanel{{-0.5, -0.4, 2}, {0, 0.8, 0}, {1, 0, 0}};  // shines downwards

struct LightOfLamps {
    std::vector<float> lx;
    double error_lx = 0;
};

LightOfLamps light_at(const Scene& scene, const Vec3& position, const Vec3& normal) {
    const rays::RayCaster caster(scene);
    const DirectLight direct(scene, caster);
    LightOfLamps light{std::vector<float>(direct.count())};
    light.error_lx = std::sqrt(direct.add({position, normal, position + 1e-5 * normal}, 1, light.lx));
    return light;
}

Scene floor_and(const Shape& shade) {
    Scene scene;
    add_object(scene, Rectangle{{-3, -3, 0}, {6, 0, 0}, {0, 6, 0}}, diffuse(0.5));
    add_object(scene, shade, diffuse(0.5));
    return scene;
}

const Shape kFarAway = Rectangle{{50, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(DirectLight, OfAPointIsExact) {
    Scene scene = floor_and(kFarAway);
    add_point_light(scene, {0.3, -0.2, 1.5}, Rgb::grey(200));
    for (const double x : {-2.0, 0.0, 0.3, 1.7}) {
        const LightOfLamps light = light_at(scene, {x, 0.5, 0}, {0, 0, 1});
        const double expected =
            exact::illuminance_by_point_lx({{x, 0.5, 0}, {0, 0, 1}}, {0.3, -0.2, 1.5}, 200);
        EXPECT_NEAR(light.lx[0], expected, 1e-5 * expected);
        EXPECT_EQ(light.error_lx, 0);
    }
}

/// From below the panel to where it is seen at a low angle, and with a part of it below the horizon.
TEST(DirectLight, OfAPanelIsThatOfItsConfigurationFactor) {
    Scene scene = floor_and(kFarAway);
    add_area_light(scene, kPanel, Rgb::grey(1000));
    const Vec3 tilted = normalized(Vec3{-1, 0.3, 0.15});
    for (const auto& [position, normal] : {std::pair{Vec3{0, 0, 0}, Vec3{0, 0, 1}},
                                           {{1.3, 0.4, 0}, {0, 0, 1}},
                                           {{2.9, -2.9, 0}, {0, 0, 1}},
                                           {{0.2, 0.1, 1.8}, {0, 0, 1}},
                                           {{0.3, 0.2, 0.5}, tilted}}) {
        const LightOfLamps light = light_at(scene, position, normal);
        const double expected = exact::illuminance_by_rectangle_lx({position, normal}, kPanel.corner,
                                                                   kPanel.edge_u, kPanel.edge_v, 1000);
        EXPECT_NEAR(light.lx[0], expected, 0.01 * expected) << position.x;
        EXPECT_LE(std::abs(light.lx[0] - expected), 4 * light.error_lx + 1e-3 * expected) << position.x;
    }
}

/// A screen right below the panel hides all but a strip: the visible rest is a panel, too.
TEST(DirectLight, CountsTheVisiblePartOfAPanel) {
    Scene scene = floor_and(Rectangle{{-0.51, -0.41, 1.999}, {0.76, 0, 0}, {0, 0.82, 0}});
    add_area_light(scene, kPanel, Rgb::grey(1000));
    const LightOfLamps light = light_at(scene, {1, 0.2, 0}, {0, 0, 1});
    const double expected = exact::illuminance_by_rectangle_lx({{1, 0.2, 0}, {0, 0, 1}}, {0.25, -0.4, 2},
                                                               {0, 0.8, 0}, {0.25, 0, 0}, 1000);
    EXPECT_NEAR(light.lx[0], expected, 0.05 * expected);
    EXPECT_LE(std::abs(light.lx[0] - expected), 4 * light.error_lx);
    EXPECT_GT(light.error_lx, 0);
}

TEST(DirectLight, PassesThroughPanes) {
    Scene scene;
    const ThinDielectric pane = materials::make<ThinDielectric>({}, "pane");
    add_object(scene, Rectangle{{-3, -3, 1}, {6, 0, 0}, {0, 6, 0}}, pane);
    add_point_light(scene, {0, 0, 2}, Rgb::grey(100));
    const LightOfLamps light = light_at(scene, {0, 0, 0}, {0, 0, 1});
    EXPECT_NEAR(light.lx[0], 25 * straight_transmittance(pane, 1).luminance(), 1e-4);
}

/// The whole sky gives pi L; light from below the horizon does not count.
TEST(DirectLight, OfTheSkyIsComplete) {
    Scene scene = floor_and(kFarAway);
    add_environment(scene, Rgb::grey(100));
    const LightOfLamps light = light_at(scene, {0, 0, 0}, {0, 0, 1});
    EXPECT_NEAR(light.lx[0], 100 * kPi, 1e-3);
}

TEST(DirectLight, KeepsLightsApart) {
    Scene scene = floor_and(Rectangle{{-1, -1, 1.9}, {2, 0, 0}, {0, 2, 0}});
    add_point_light(scene, {0, 0, 1}, Rgb::grey(100));
    add_area_light(scene, kPanel, Rgb::grey(1000));
    add_point_light(scene, {0, 0, 1}, Rgb{{100, 0, 0}});
    const LightOfLamps light = light_at(scene, {0, 0, 0}, {0, 0, 1});
    EXPECT_FLOAT_EQ(light.lx[0], 100);
    EXPECT_EQ(light.lx[1], 0);
    EXPECT_FLOAT_EQ(light.lx[2], 21.26F);
}

}  // namespace
}  // namespace stilb::walk
