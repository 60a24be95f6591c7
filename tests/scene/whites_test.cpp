#include "scene/whites.h"

#include <gtest/gtest.h>

#include "lights/colour_temperature.h"

namespace stilb::scene {
namespace {

struct Lamp {
    Rgb colour;
    double candela = 100;
};

Rgb at(double kelvin) { return lights::colour_of_temperature(kelvin); }

Scene lit_by(std::initializer_list<Lamp> lamps) {
    Scene scene;
    for (const Lamp& lamp : lamps)
        scene.lights.push_back({"lamp", PointLight{{0, 0, 1}, lamp.candela * lamp.colour}});
    return scene;
}

void expect_range(const Scene& scene, double warmest_k, double coolest_k) {
    const WhiteRange range = whites_of_lights(scene);
    for (std::size_t b = 0; b < kBands; ++b) {
        EXPECT_NEAR(range.warmest[b], at(warmest_k)[b], 1e-12);
        EXPECT_NEAR(range.coolest[b], at(coolest_k)[b], 1e-12);
    }
}

TEST(Whites, AreThoseOfTheLamps) {
    expect_range(lit_by({{at(4000), 300}}), 4000, 4000);
    expect_range(lit_by({{at(6000)}, {at(3000)}, {at(4000)}}), 3000, 6000);
}

TEST(Whites, AreTheScreensWithoutWhiteLight) {
    const Rgb red{{4.7, 0, 0}}, green{{0, 1.4, 0}}, blue{{0, 0, 13.8}};
    for (const Scene& scene : {Scene{}, lit_by({{red}, {green}, {blue}}), lit_by({{Rgb{}}})}) {
        EXPECT_EQ(whites_of_lights(scene).warmest, Rgb::grey(1));
        EXPECT_EQ(whites_of_lights(scene).coolest, Rgb::grey(1));
    }
}

TEST(Whites, LeaveColouredLightOut) {
    expect_range(lit_by({{at(3000), 10}, {{{4.7, 0, 0}}, 1000}, {{{0, 0, 13.8}}, 1000}}), 3000, 3000);
}

TEST(Whites, LeaveOutWhatHardlyCounts) {
    // A candle of 1 % of the flux; forty lamps of 2.5 % each count.
    expect_range(lit_by({{at(1900), 1}, {at(4000), 99}}), 4000, 4000);
    Scene hall;
    for (int i = 0; i < 40; ++i)
        hall.lights.push_back({"lamp", PointLight{{0, 0, 1}, at(i < 20 ? 3000 : 5000)}});
    expect_range(hall, 3000, 5000);
}

TEST(Whites, IncludeAnEnvironmentThatCounts) {
    // pi sr of 1 cd/m2 on the 1e-6 m2 or so of the bounds of one lamp are next to nothing.
    Scene scene = lit_by({{at(3000), 100}});
    EnvironmentLight sky;
    sky.luminance_cd_m2 = at(9000);
    scene.lights.push_back({"sky", sky});
    expect_range(scene, 3000, 3000);
    scene.lights.push_back({"far lamp", PointLight{{100, 100, 30}, 100 * at(3000)}});
    expect_range(scene, 3000, 9000);
}

}  // namespace
}  // namespace stilb::scene
