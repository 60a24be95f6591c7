// Lamps of Radiance: luminances, distributions by ies2rad against the luminaire files, cones, skies.
#include <cmath>

#include "io/photometry/photometry_file.h"
#include "io/text/radiance_units.h"
#include "radiance_text.h"
#include "run/run.h"
#include "sensors/sensor.h"

namespace stilb::io {
namespace {

constexpr double kDegree = kPi / 180;
/// 179 lm/W times the weights of Radiance.
double luminous(double red, double green, double blue) {
    return 179 * (0.265 * red + 0.670 * green + 0.065 * blue);
}

/// The illuminance at a point, within the error of a few thousand paths.
statistics::Estimate illuminance(const SceneFile& file, const Vec3& position, const Vec3& normal,
                                 std::uint64_t paths = 4096) {
    RunOptions options;
    options.paths = paths;
    const Sensor sensor{"point", IlluminancePoints{{{position, normal}}}};
    return run::measure(file.scene, std::span(&sensor, 1), options).sensors.at(0).readings.at(0).estimate;
}
void expect_estimate(const statistics::Estimate& estimate, double expected, double tolerance) {
    EXPECT_NEAR(estimate.value, expected, 4 * estimate.standard_error + tolerance * expected);
    EXPECT_LT(estimate.standard_error, 0.01 * expected);
}

/// The luminance of a lamp that leaves along a direction.
Rgb luminance_along(const Scene& scene, const Light& light, const Vec3& leaving) {
    const lights::OpeningEmitter emitter(std::get<LuminousOpening>(light.source),
                                         scene::LightSurroundings(scene), scene::lift_of(scene));
    return emitter.luminance_cd_m2(leaving);
}

TEST(RadianceLamps, LightHasTheLuminanceOfRadiancesWeights) {
    const SceneFile file = read_rad(
        "void light red 0 0 3 10 2 1\nred polygon panel 0 0 12 0 0 2 0 1 2 3 1 2 3 0 2\nred sphere bulb 0 0 "
        "4 9 9 "
        "9 .1\n");
    ASSERT_EQ(file.scene.lights.size(), 2u);
    for (const Light& light : file.scene.lights) {
        const auto& area = std::get<AreaLight>(light.source);
        EXPECT_NEAR(area.luminance_cd_m2.luminance(), luminous(10, 2, 1), 1e-9);
        const Rgb back = radiometric(area.luminance_cd_m2);
        EXPECT_NEAR(back[0], 10, 1e-12);
        EXPECT_NEAR(back[1], 2, 1e-12);
        EXPECT_NEAR(back[2], 1, 1e-12);
        EXPECT_EQ(light.group, "red");
    }
    EXPECT_NEAR(scene::flux_lm(file.scene, file.scene.lights[1]).luminance(),
                kPi * luminous(10, 2, 1) * (file.scene.lights[1].name == "bulb" ? 0.04 * kPi : 3), 1e-6);
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0],
              "Radiance: lengths in m; luminances are 179 lm/W times 0.265 R + 0.67 G + 0.065 B "
              "(docs/radiance.md)");
}

TEST(RadianceLamps, LampsShineOnTheirFrontOnly) {
    // Two small panels back to back, the front of the first one downwards.
    const SceneFile file =
        read_rad("void light a 0 0 3 100 100 100\na polygon p 0 0 12 0 0 2 0 .1 2 .1 .1 2 .1 0 2\n");
    const auto below = illuminance(file, {.05, .05, 0}, {0, 0, 1});
    // A square of 0.1 m seen from 2 m below its middle, in closed form: four rectangles of 0.05 m at a
    // corner.
    const double a = .05 / 2, b = a, root = std::sqrt(1 + a * a);
    const double corner = 2 * (a / root) * std::atan(b / root) / (2 * kPi);
    expect_estimate(below, kPi * luminous(100, 100, 100) * 4 * corner, 1e-6);
    EXPECT_EQ(illuminance(file, {.05, .05, 4}, {0, 0, -1}).value, 0);
}

TEST(RadianceLamps, ConnectedPolygonsAreOneLamp) {
    const SceneFile file = read_rad(
        "void light a 0 0 3 1 1 1\n!genbox a cube 1 1 1 | xform -a 3 -t 2 0 0\na polygon t 0 0 9 0 0 5 1 0 5 "
        "0 1 "
        "5\na ring r 0 0 8 9 9 9 0 0 1 0 1\na ring r 0 0 8 9 9 9 0 0 1 .5 1\na tube u 0 0 7 0 0 7 0 0 8 1\n");
    std::vector<std::string> names;
    for (const Light& light : file.scene.lights) names.push_back(light.name);
    std::ranges::sort(names);
    EXPECT_EQ(names, (std::vector<std::string>{"a", "a_2", "a_3", "r", "r_2", "t", "u"}));
}

TEST(RadianceLamps, GlowsAndIllums) {
    const SceneFile file = read_rad(
        "void glow a 0 0 4 1 1 1 -1\nvoid glow b 0 0 4 2 2 2 0\nvoid illum c 1 void 0 3 3 3 3\n"
        "a sphere sa 0 0 4 0 0 0 1\nb sphere sb 0 0 4 3 0 0 1\nc sphere sc 0 0 4 6 0 0 1\n");
    ASSERT_EQ(file.scene.lights.size(), 2u);
    EXPECT_EQ(file.scene.objects.size(), 3u);
    EXPECT_EQ(warnings_of(file),
              (std::vector<std::string>{
                  "glow a: it lights nothing, because its radius is below 0. It is dark here.",
                  "illum c: it is seen as a lamp here; in Radiance it only casts its light."}));
}

class RadianceLuminaires : public testing::TestWithParam<const char*> {};

/// What ies2rad made of a luminaire file sends the intensities of the file.
TEST_P(RadianceLuminaires, HaveTheIntensitiesOfTheirFile) {
    const std::string name = GetParam();
    const auto folder = kRadianceData / "luminaires";
    const SceneFile file =
        read_radiance_scene("!xform -rx 25 -rz 40 -t 1 2 3 " + name + ".rad\n", "r.rad", folder);
    const PhotometricSolid of_file(read_photometry_file(folder / (name + ".ies")).grid);
    const geometry::Transform turn =
        compose(geometry::Transform::rotation({0, 0, 1}, 40), geometry::Transform::rotation({1, 0, 0}, 25));
    // ies2rad puts plane 270 of a file of planes 90 to 270 where others have plane 90.
    const double side = name == "half" ? -1 : 1;
    // Tables have six digits; the side of a cylinder has 96 faces.
    const double rounding = name == "cylinder" ? 1e-4 : 2e-5;
    double flux = 0;
    for (const Light& light : file.scene.lights) flux += scene::flux_lm(file.scene, light).luminance();
    EXPECT_NEAR(flux, of_file.flux_lm(), 1e-4 * of_file.flux_lm());
    for (double polar = 3; polar < 180; polar += 11) {
        for (double plane = 1; plane < 360; plane += 17) {
            const Vec3 own{std::sin(polar * kDegree) * std::cos(plane * kDegree),
                           std::sin(polar * kDegree) * std::sin(plane * kDegree), -std::cos(polar * kDegree)};
            const Vec3 leaving = turn.direction(own);
            double intensity = 0;
            for (const Light& light : file.scene.lights) {
                const auto& opening = std::get<LuminousOpening>(light.source);
                const lights::EmitterSurface surface(file.scene.object(opening.object).shape,
                                                     scene::lift_of(file.scene));
                intensity += surface.projected_area_m2(leaving) *
                             luminance_along(file.scene, light, leaving).luminance();
            }
            const double expected = of_file.intensity_cd({side * own.x, side * own.y, -own.z});
            EXPECT_NEAR(intensity, expected, rounding * of_file.peak_cd()) << polar << " " << plane;
        }
    }
    EXPECT_TRUE(file.warnings.empty());
}
INSTANTIATE_TEST_SUITE_P(Files, RadianceLuminaires,
                         testing::Values("box", "cylinder", "ball", "half", "whole"),
                         [](const auto& of) { return std::string(of.param); });

/// Radiance's illuminance is L A cos / (d + focus)^2: a quarter at 2 m, for a focus as far behind.
TEST(RadianceLamps, SpotlightsWithAFocusAreWarnedOf) {
    const SceneFile file =
        read_rad("void spotlight beam 0 0 7 50 50 50 40 0 0 -2\nbeam ring r 0 0 8 0 0 3 0 0 -1 0 .1\n");
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].text.find(
                  "from a focus 2 m behind it, the length of its direction: 2 m away this is 4 "
                  "times Radiance's illuminance"),
              std::string::npos)
        << file.warnings[0].text;
}

TEST(RadianceLamps, SpotlightsEmitInTheirConeOnly) {
    const SceneFile file =
        read_rad("void spotlight beam 0 0 7 50 50 50 40 .001 0 -.001\nbeam ring r 0 0 8 0 0 3 0 0 -1 0 .1\n");
    const Light& light = file.scene.lights.at(0);
    const Vec3 aim = normalized(Vec3{1, 0, -1});
    const Frame frame = Frame::around(aim);
    for (double off = 0.5; off < 40; off += 1) {
        for (double turn = 0; turn < 360; turn += 30) {
            const Vec3 w = std::cos(off * kDegree) * aim +
                           std::sin(off * kDegree) *
                               (std::cos(turn * kDegree) * frame.u + std::sin(turn * kDegree) * frame.v);
            const double expected = off < 20 && w.z < 0 ? luminous(50, 50, 50) : 0;
            EXPECT_NEAR(luminance_along(file.scene, light, w).luminance(), expected,
                        2e-3 * luminous(50, 50, 50))
                << off << " " << turn;
        }
    }
    // In the axis: L A cos / d^2.
    const auto lit = illuminance(file, {3, 0, 0}, normalized(Vec3{-1, 0, 1}), 16384);
    expect_estimate(lit, luminous(50, 50, 50) * kPi * 0.01 * std::cos(45 * kDegree) / 18, 2e-3);
    EXPECT_EQ(illuminance(file, {0, 0, 0}, {0, 0, 1}).value, 0);
}

TEST(RadianceLamps, SkiesAndSuns) {
    const std::string ground = with_material("m ring g 0 0 8 0 0 0 0 0 1 0 .1\n");
    const auto at = [&](const std::string& sky) {
        return illuminance(read_rad(ground + sky), {0, 0, 1}, {0, 0, 1}, 16384);
    };
    const std::string glow = "void glow sky 0 0 4 2 2 2 0\n";
    expect_estimate(at(glow + "sky source s 0 0 4 0 0 1 360\n"), kPi * luminous(2, 2, 2), 1e-4);
    expect_estimate(at(glow + "sky source s 0 0 4 0 0 1 180\n"), kPi * luminous(2, 2, 2), 2e-3);
    // A part of the sky around a slanted direction, wholly above the ground: pi sin^2 cos.
    expect_estimate(at(glow + "sky source s 0 0 4 1 0 1 60\n"),
                    kPi * luminous(2, 2, 2) * 0.25 * std::cos(45 * kDegree), 3e-3);
    const std::string sun = "void light sun 0 0 3 1e6 1e6 1e6\nsun source s 0 0 4 0 1 1 0.533\n";
    const double sun_lx =
        kPi * luminous(1e6, 1e6, 1e6) * std::pow(std::sin(0.2665 * kDegree), 2) * std::cos(45 * kDegree);
    expect_estimate(at(sun), sun_lx, 3e-3);
    expect_estimate(at(sun + glow + "sky source s2 0 0 4 0 0 1 360\n"), sun_lx + kPi * luminous(2, 2, 2),
                    3e-3);
}

TEST(RadianceLamps, PatternsThatAreNotOfIes2radAreLeftOut) {
    const SceneFile file = read_rad(
        "void brightfunc dim 2 f f.cal 0 0\ndim brightdata d 4 corr x.dat my.cal angle 0 0\nd light l 0 0 3 "
        "1 1 1\n"
        "l sphere s 0 0 4 0 0 0 1\n");
    EXPECT_EQ(
        warnings_of(file),
        (std::vector<std::string>{
            "brightfunc dim: it is left out: l has the radiance of its own numbers.",
            "brightdata d: it is left out, and its factor is 1: only the functions of source.cal, which "
            "ies2rad uses, and of luminaire.cal by Stilb are supported."}));
    EXPECT_EQ(
        refusal_of_rad("void brightdata d 4 corr x.dat source.cal src_theta 0 0\nd light l 0 0 3 1 1 1\n"
                       "l sphere s 0 0 4 0 0 0 1\n"),
        "r.rad:1: there is no file \"x.dat\", neither beside this file, nor beside the scene's, nor in a "
        "folder of "
        "the environment variable RAYPATH, which is not set.");
}

/// The surfaces of a room and of a lamp that the file gives twice.
TEST(RadianceLamps, PolygonsThatLieTwiceShineOnce) {
    const std::string room =
        "void plastic grey 0 0 5 .5 .5 .5 0 0\nvoid light lum 0 0 3 20 20 20\n"
        "grey polygon floor 0 0 12 0 0 0 4 0 0 4 3 0 0 3 0\n"
        "lum polygon lamp 0 0 12  1.7 1.2 2.49  1.7 1.8 2.49  2.3 1.8 2.49  2.3 1.2 2.49\n";
    const SceneFile once = read_rad(room);
    for (const char* copy :
         {"lum polygon copy 0 0 12  1.7 1.2 2.49  1.7 1.8 2.49  2.3 1.8 2.49  2.3 1.2 2.49\n",
          "lum polygon copy 0 0 12  1.7 1.8 2.49  2.3 1.8 2.49  2.3 1.2 2.49  1.7 1.2 2.49\n"}) {
        const SceneFile twice = read_rad(room + copy);
        ASSERT_EQ(twice.scene.lights.size(), 1u);
        EXPECT_NEAR(flux_lm(twice.scene, twice.scene.lights[0]).luminance(),
                    flux_lm(once.scene, once.scene.lights[0]).luminance(), 1e-9);
        ASSERT_EQ(twice.warnings.size(), once.warnings.size() + 1);
        EXPECT_NE(twice.warnings.back().text.find("copy: it lies where \"lamp\" does"), std::string::npos)
            << twice.warnings.back().text;
        EXPECT_NEAR(illuminance(twice, {2, 1.5, 0.8}, {0, 0, 1}).value,
                    illuminance(once, {2, 1.5, 0.8}, {0, 0, 1}).value, 1e-6);
    }
}

}  // namespace
}  // namespace stilb::io
