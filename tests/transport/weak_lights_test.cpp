#include "transport/weak_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/scene_builder.h"
#include "transport/light_sampler.h"

namespace stilb::transport {
namespace {

std::vector<double> shares(const std::vector<double>& weights) {
    std::vector<double> own = emission_favours(weights);
    for (std::size_t i = 0; i < own.size(); ++i) own[i] *= weights[i];
    const double all = std::accumulate(own.begin(), own.end(), 0.0);
    for (double& share : own) share /= all;
    return own;
}

TEST(EmissionFavours, AreForWeakLightsOnly) {
    for (const auto& weights : {std::vector<double>{5}, {1, 2, 3}, {16, 1}, {0, 4, 60}, {}})
        for (const double favour : emission_favours(weights)) EXPECT_EQ(favour, 1);
    const std::vector<double> signs = shares({1e6, 1e6, 20, 20, 0});
    EXPECT_NEAR(signs[2] + signs[3], kWeakShare / (1 + kWeakShare), 1e-3);
    EXPECT_EQ(signs[2], signs[3]);
    EXPECT_EQ(signs[4], 0);
}

TEST(EmissionFavours, OfEachStrength) {
    std::vector<double> weights;
    for (int i = 0; i < 5; ++i) weights.push_back(std::pow(1e-4, i));
    for (const double share : shares(weights)) EXPECT_GT(share, 0.06);
}

/// A small lamp in a closed ball, a strong one or the sky outside.
Scene sign_in_a_ball(double sign_cd, double other_cd, bool is_sky) {
    Scene scene;
    add_object(scene, Sphere{{0, 0, 0}, 1}, diffuse(0.5));
    add_point_light(scene, {0, 0, 0}, Rgb::grey(sign_cd));
    if (is_sky) add_environment(scene, Rgb::grey(other_cd));
    if (!is_sky) add_point_light(scene, {0, 0, 5}, Rgb::grey(other_cd));
    return scene;
}

double share_of_first(const Scene& scene) {
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const Vec3 floor{0, 0, -1}, up{0, 0, 1};
    const double own = lights.rough_illuminance_lx(0, {floor, up});
    return own / (own + lights.rough_illuminance_lx(1, {floor, up}));
}

TEST(ChoiceFavours, GiveWeakLightsAShareWhereTheyShine) {
    EXPECT_GT(share_of_first(sign_in_a_ball(1, 1e4, true)), kWeakChoice / 2);
    EXPECT_GT(share_of_first(sign_in_a_ball(1e-6, 1e9, false)), kWeakChoice / 2);
}

/// The weak one gets a share, however little weaker than a comparable one it is.
TEST(ChoiceFavours, BeginAbove16Times) {
    for (const double other_cd : {16.1, 17.0}) {
        const Scene scene = sign_in_a_ball(1, other_cd, false);
        const rays::RayCaster caster(scene);
        EXPECT_GE(LightSampler(scene, caster).choice_favour(0), 1) << other_cd;
        EXPECT_GT(share_of_first(scene), 0.5);
    }
    for (const double weight : {15.9, 16.0, 16.1}) {
        const double favour = emission_favours(std::vector<double>{weight, 1})[1];
        EXPECT_EQ(favour > 1, weight > 16) << weight;
    }
}

TEST(ChoiceFavours, LeaveComparableLightsAlone) {
    for (const double other_cd : {0.01, 1.0, 15.9, 16.0}) {
        const Scene scene = sign_in_a_ball(1, other_cd, false);
        const rays::RayCaster caster(scene);
        const LightSampler lights(scene, caster);
        EXPECT_EQ(lights.choice_favour(0), 1) << other_cd;
    }
}

}  // namespace
}  // namespace stilb::transport
