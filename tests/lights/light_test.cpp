#include "lights/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/scene_builder.h"

namespace stilb::lights {
namespace {

/// A point light whose emitter cannot be chosen among others.
struct NotChosenEmitter {
    NotChosenEmitter(const auto&, const Surroundings&, const Lift&) {}
    Emission emit(math::SampleStream&) const { return {}; }
    std::optional<IncidentLight> sample_incident(const SurfacePoint&, const std::array<double, 2>&) const {
        return std::nullopt;
    }
};
struct NotChosen : PointLight {
    using Emitter = NotChosenEmitter;
};
/// A point light that says that rays find it.
struct OnNoSurface : PointLight {
    static constexpr LightLocation kLocation = LightLocation::surface;
};
static_assert(LightKind<PointLight> && LightKind<Luminaire> && LightKind<LuminousOpening> &&
              LightKind<AreaLight> && LightKind<EnvironmentLight>);
/// A point light that does not say which lights it is like.
struct LikeNone : PointLight {
    void shines_like(const LikeNone&) const {}
};
static_assert(!LightKind<NotChosen> && !LightKind<OnNoSurface> && !LightKind<LikeNone>);

/// One light of each place.
Scene three_lights() {
    Scene scene;
    add_point_light(scene, {1, 2, 3}, {{1, 2, 3}});
    add_area_light(scene, Rectangle{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, Rgb::grey(5));
    add_environment(scene, Rgb::grey(7));
    return scene;
}

std::vector<std::string> keys_of(const Light& light, const Scene& scene) {
    std::vector<std::string> keys;
    for (const LightDetail& detail : details_of(light, scene::LightSurroundings(scene)))
        keys.emplace_back(detail.key);
    return keys;
}

TEST(Light, IsAtOnePlace) {
    const Scene scene = three_lights();
    const Light &point = scene.lights[0], &area = scene.lights[1], &environment = scene.lights[2];
    EXPECT_EQ(location_of(point), LightLocation::point);
    EXPECT_EQ(location_of(area), LightLocation::surface);
    EXPECT_EQ(location_of(environment), LightLocation::infinity);
    ASSERT_TRUE(point_origin(point));
    EXPECT_EQ(point_origin(point)->position, (Vec3{1, 2, 3}));
    EXPECT_FALSE(point_origin(area) || point_origin(environment));
    ASSERT_TRUE(uniform_emission(area));
    EXPECT_EQ(uniform_emission(area)->object, ObjectId{0});
    EXPECT_EQ(uniform_emission(area)->luminance_cd_m2, Rgb::grey(5));
    EXPECT_FALSE(uniform_emission(point) || uniform_emission(environment));
}

TEST(Light, ShinesLikeOthersOfItsKindAndDirections) {
    Scene scene = three_lights();
    const Light &point = scene.lights[0], &area = scene.lights[1];
    EXPECT_EQ(point_origin(point)->intensity_cd, std::optional(Rgb{{1, 2, 3}}));
    EXPECT_TRUE(shine_alike(point, {"", PointLight{{4, 5, 6}, Rgb::grey(1)}}));
    EXPECT_FALSE(shine_alike(point, area));
    Luminaire luminaire{{0, 0, 2}, SolidId{0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}, Rgb::grey(1)};
    const Light down{"", luminaire}, opening{"", LuminousOpening{ObjectId{0}, luminaire}};
    luminaire.position = {3, 0, 2};
    EXPECT_TRUE(shine_alike(down, {"", luminaire}));
    EXPECT_FALSE(point_origin(down)->intensity_cd);
    EXPECT_TRUE(shine_alike(opening, {"", LuminousOpening{ObjectId{1}, luminaire}}));
    EXPECT_FALSE(shine_alike(down, opening));
    luminaire.nadir = {0, 0, 1};
    EXPECT_FALSE(shine_alike(down, {"", luminaire}));
    EXPECT_FALSE(shine_alike(opening, {"", LuminousOpening{ObjectId{0}, luminaire}}));
    EXPECT_EQ(opening_of(opening), ObjectId{0});
    EXPECT_FALSE(opening_of(down) || opening_of(area) || opening_of(point));
    EXPECT_TRUE(luminaire_of(down) && luminaire_of(opening));
    EXPECT_FALSE(luminaire_of(area) || luminaire_of(point) || luminaire_of(scene.lights[2]));
}

TEST(Light, SaysWhatItIs) {
    const Scene scene = three_lights();
    using Keys = std::vector<std::string>;
    EXPECT_EQ(type_of(scene.lights[0]), "point");
    EXPECT_EQ(keys_of(scene.lights[0], scene), Keys{"intensity_cd"});
    EXPECT_EQ(type_of(scene.lights[1]), "area");
    EXPECT_EQ(keys_of(scene.lights[1], scene), (Keys{"object", "luminance_cd_m2"}));
    EXPECT_EQ(type_of(scene.lights[2]), "environment");
    EXPECT_EQ(keys_of(scene.lights[2], scene), (Keys{"luminance_cd_m2", "horizontal_illuminance_lx"}));
}

/// The flux of an environment is that which enters the scene's bounding box, pi L for each square metre of
/// it. The box spans the rectangle and the point light, and is enlarged by a thousandth of its half extent.
TEST(Light, HasItsFlux) {
    const Scene scene = three_lights();
    constexpr double pi = std::numbers::pi;
    for (std::size_t b = 0; b < kBands; ++b)
        EXPECT_NEAR(scene::flux_lm(scene, scene.lights[0])[b], 4 * pi * static_cast<double>(b + 1), 1e-12);
    EXPECT_NEAR(scene::flux_lm(scene, scene.lights[1])[0], pi * 2 * 5, 1e-12);
    const double box_m2 = 2 * (2 * 2 + 2 * 3 + 2 * 3);
    EXPECT_NEAR(scene::flux_lm(scene, scene.lights[2])[0], pi * 7 * box_m2, 0.005 * pi * 7 * box_m2);
}

}  // namespace
}  // namespace stilb::lights
