#include "scene/light_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "stilb/error.h"

namespace stilb::scene {
namespace {

Scene scene_with(std::initializer_list<std::pair<const char*, const char*>> lights) {
    Scene scene;
    for (const auto& [name, group] : lights)
        scene.lights.push_back({name, PointLight{{0, 0, 1}, Rgb::grey(10)}, group});
    return scene;
}

TEST(LightGroups, LightsOfOneGroupAreTogether) {
    const LightGroups groups = light_groups(scene_with({{"a", "desk"}, {"b", ""}, {"c", "desk"}, {"d", ""}}));
    EXPECT_EQ(groups.names, (std::vector<std::string>{"desk", "b", "d"}));
    EXPECT_EQ(groups.of_light, (std::vector<std::uint32_t>{0, 1, 0, 2}));
}

TEST(LightGroups, ThereAreNotTooMany) {
    Scene scene;
    for (int i = 0; i < 40; ++i)
        scene.lights.push_back({"light_" + std::to_string(i), PointLight{{0, 0, 1}, Rgb::grey(10)}});
    const LightGroups groups = light_groups(scene);
    EXPECT_EQ(groups.count(), kMostLightGroups);
    EXPECT_EQ(groups.names.back(), kOtherLights);
    EXPECT_EQ(groups.of_light[30], 30u);
    EXPECT_EQ(groups.of_light[31], 31u);
    EXPECT_EQ(groups.of_light[39], 31u);
}

TEST(LightGroups, UpTo32EachHasItsOwn) {
    for (const std::uint32_t lights : {31, 32, 33}) {
        Scene scene;
        for (std::uint32_t i = 0; i < lights; ++i)
            scene.lights.push_back({"light_" + std::to_string(i), PointLight{{0, 0, 1}, Rgb::grey(10)}});
        const LightGroups groups = light_groups(scene);
        EXPECT_EQ(groups.count(), std::min(lights, 32u));
        EXPECT_EQ(groups.names.back(), lights <= 32 ? "light_" + std::to_string(lights - 1) : "others");
        for (std::uint32_t i = 0; i < lights; ++i) EXPECT_EQ(groups.of_light[i], std::min(i, 31u));
    }
}

TEST(LightGroups, FactorsScaleTheirLights) {
    const Scene scene = scene_with({{"a", "desk"}, {"b", ""}});
    const LightGroups groups = light_groups(scene);
    const auto factors = factors_of_groups(std::vector<LightFactor>{{"desk", {{0.5, 1, 2}}}}, groups.names);
    const Scene dimmed = relit(scene, groups, factors);
    EXPECT_EQ(std::get<PointLight>(dimmed.lights[0].source).intensity_cd, (Rgb{{5, 10, 20}}));
    EXPECT_EQ(std::get<PointLight>(dimmed.lights[1].source).intensity_cd, Rgb::grey(10));
}

TEST(LightGroups, UnknownNamesAreRefused) {
    try {
        factors_of_groups(std::vector<LightFactor>{{"sun", Rgb::grey(1)}},
                          std::vector<std::string>{"desk", "b"});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "there is no light or group of lights \"sun\". Allowed: desk, b.");
    }
}

/// Each kind of light can be dimmed, to darkness too.
TEST(LightGroups, AllKindsOfLightAreScaled) {
    EnvironmentLight sky;
    sky.panorama =
        std::make_shared<const Panorama>(Panorama::Image{2, 1, {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}}});
    const auto half = std::get<EnvironmentLight>(lights::scaled(sky, Rgb::grey(0.5)));
    EXPECT_EQ(half.panorama->luminance_cd_m2({1, 0, 0}), sky.panorama->luminance_cd_m2({1, 0, 0}) * 0.5);
    const auto dark = std::get<EnvironmentLight>(lights::scaled(sky, Rgb{}));
    EXPECT_EQ(dark.panorama, nullptr);
    EXPECT_EQ(dark.luminance_cd_m2, Rgb{});
    const auto area = std::get<AreaLight>(lights::scaled(AreaLight{{}, Rgb::grey(2)}, {{1, 2, 3}}));
    EXPECT_EQ(area.luminance_cd_m2, (Rgb{{2, 4, 6}}));
}

}  // namespace
}  // namespace stilb::scene
