// Skies of gensky and gendaylit: their formulas against rcalc with Radiance's own skybright.cal and
// perezlum.cal, and their light against closed forms.
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "io/import/radiance/sky_pattern.h"
#include "io/text/radiance_units.h"
#include "radiance_text.h"

namespace stilb::io {
namespace {

constexpr std::string_view kSun = " 0.517649 -0.296573 0.802549\n";

radiance::SkyPattern sky_pattern(const std::string& texts, const std::string& numbers) {
    const radiance::Description description =
        describe_rad("void brightfunc skyfunc " + texts + " 0 " + numbers + "\n");
    const auto pattern = radiance::read_sky_pattern(description.modifiers.at(0), description);
    EXPECT_TRUE(pattern);
    return pattern.value();
}

void expect_factors(const radiance::SkyPattern& pattern, const std::array<double, 6>& expected) {
    const std::array<Vec3, 6> directions{{{0, 0, 1},
                                          {0.6, -0.32, 0.733212111},
                                          {-0.8, 0, 0.6},
                                          {0.1, 0.99, 0.0995},
                                          {0.999987, 0, 0.005},
                                          {0, -0.6, -0.8}}};
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(pattern.factor(directions[i]), expected[i], 2e-5 * expected[i]) << i;
}

TEST(RadianceSky, HasTheFormulasOfGensky) {
    const std::string texts = "2 skybr skybright.cal", sun(kSun);
    expect_factors(sky_pattern(texts, "7 1 12.22 24.34 0.7314" + sun),
                   {12.212944, 50.4554525, 7.05958204, 16.632429, 24.7398777, 24.34});
    expect_factors(sky_pattern(texts, "7 4 23.41 7.794 0.9765" + sun),
                   {23.4037223, 61.2674287, 9.71298126, 10.1038719, 16.066991, 7.794});
    expect_factors(sky_pattern(texts, "3 2 34.61 5.383"),
                   {34.6099748, 28.4539705, 25.3792064, 12.8925885, 8.98078466, 5.383});
    expect_factors(sky_pattern(texts, "3 3 34.61 6.921"),
                   {34.6099761, 34.6095876, 34.6079781, 31.5300182, 22.8116571, 6.921});
}

TEST(RadianceSky, HasTheFormulaOfGendaylit) {
    expect_factors(
        sky_pattern("2 skybright /usr/share/perezlum.cal",
                    "10 41.93 22.8 -0.981147 -0.292013 13.033848 -3.478970 0.188397" + std::string(kSun)),
        {28.3740794, 144.034535, 17.8191203, 39.1402682, 43.9718609, 22.8});
}

TEST(RadianceSky, TurnsWithXform) {
    const std::string numbers = "7 1 12.22 24.34 0.7314" + std::string(kSun);
    const auto straight = sky_pattern("2 skybr skybright.cal", numbers);
    const auto turned = sky_pattern("4 skybr skybright.cal -rz 90", numbers);
    const Vec3 w = normalized(Vec3{0.6, -0.32, 0.7});
    EXPECT_NEAR(turned.factor({-w.y, w.x, w.z}), straight.factor(w), 1e-9);
    EXPECT_NE(turned.factor(w), straight.factor(w));
}

/// The numbers of the primitive of this name.
std::vector<double> numbers_of_sky(const std::string& arguments, const std::string& name) {
    const radiance::Description description = describe_rad("!gensky " + arguments + "\n");
    if (name == "sun")
        return description.surfaces.empty() ? std::vector<double>{} : numbers_of(description, 0);
    for (const radiance::Modifier& modifier : description.modifiers) {
        if (modifier.name == name) return modifier.numbers;
    }
    return {};
}
void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    // Four digits, directions six decimals.
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 5.1e-4 * std::abs(expected[i]) + 6e-7) << i;
}

/// Expected numbers are those that gensky of pyradiance 1.3 prints.
TEST(RadianceSky, ComesOfTheCommandGensky) {
    const std::string munich = " -a 48 -o -11 -m -15";
    const std::vector<double> sun{0.517649, -0.296573, 0.802549};
    expect_near(numbers_of_sky("6 21 10 +s" + munich, "solar"), {6.951e6, 6.951e6, 6.951e6});
    expect_near(numbers_of_sky("6 21 10 +s" + munich, "sun"), {sun[0], sun[1], sun[2], 0.5});
    expect_near(numbers_of_sky("6 21 10 +s" + munich, "skyfunc"),
                {1, 12.22, 24.34, 0.7314, sun[0], sun[1], sun[2]});
    expect_near(numbers_of_sky("6 21 10 +i" + munich, "skyfunc"),
                {4, 23.41, 7.794, 0.9765, sun[0], sun[1], sun[2]});
    expect_near(numbers_of_sky("6 21 10 +i" + munich, "solar"), {1.043e6, 1.043e6, 1.043e6});
    expect_near(numbers_of_sky("6 21 10 -c" + munich, "skyfunc"), {2, 34.61, 5.383});
    expect_near(numbers_of_sky("6 21 10 -u" + munich, "skyfunc"), {3, 34.61, 6.921});
    expect_near(numbers_of_sky("12 21 12:30 -a 60 -o 10 -m 0", "sun"), {0.029146, -0.993074, 0.113822, 0.5});
    expect_near(numbers_of_sky("6 21 +10" + munich, "sun"), {0.458701, -0.324133, 0.827364, 0.5});
    expect_near(numbers_of_sky("6 21 10", "sun"), {0.491441, -0.160574, 0.855980, 0.5});
    const std::vector<double> at_40{-0.383022, -0.663414, 0.642788};
    const auto clear = [&](double zenith, double ground) {
        return std::vector<double>{1, zenith, ground, 0.5002, at_40[0], at_40[1], at_40[2]};
    };
    expect_near(numbers_of_sky("-ang 40 30 -t 4 -g .3", "skyfunc"), clear(17.14, 33.23));
    expect_near(numbers_of_sky("-ang 40 30 -b 20", "skyfunc"), clear(20, 23.14));
    expect_near(numbers_of_sky("-ang 40 30 -B 100", "skyfunc"), clear(18.52, 22.63));
    expect_near(numbers_of_sky("-ang 40 30 -R 300", "skyfunc"), clear(8.325, 22.02));
    expect_near(numbers_of_sky("-ang 40 30 -R 300", "solar"), {7.805e6, 7.805e6, 7.805e6});
    expect_near(numbers_of_sky("-ang 40 30 -r 5e6", "skyfunc"), clear(8.325, 15.14));
    expect_near(numbers_of_sky("-ang 40 30 -c -B 55.866", "skyfunc"), {2, 22.86, 3.557});
    // The sun is limited to 87 degrees, and sets.
    expect_near(numbers_of_sky("-ang 89 30", "skyfunc"),
                {1, 148.6, 37.99, 2.714, -0.026168, -0.045324, 0.998630});
    expect_near(numbers_of_sky("-ang -5 30", "skyfunc"),
                {1, 1.199, 0.5044, 0.2692, -0.498097, -0.862730, -0.087156});
    EXPECT_TRUE(numbers_of_sky("-ang -5 30", "sun").empty());
    EXPECT_TRUE(numbers_of_sky("-ang 40 30 -s", "sun").empty());
    EXPECT_EQ(numbers_of_sky("-ang -5 30 -c", "skyfunc"), (std::vector<double>{2, 0, 0}));
}

TEST(RadianceSky, ACommandTurnsTheSunByItsPipeline) {
    const auto description = describe_rad("!gensky -ang 40 0 +s | xform -rz 90\n");
    expect_numbers(description, 0, {std::cos(40 * kPi / 180), 0, std::sin(40 * kPi / 180), 0.5});
}

TEST(RadianceSky, WrongArgumentsOfGenskyAreNamed) {
    EXPECT_EQ(refusal_of_rad("\n!gensky 6 21\n"),
              "r.rad:2: arguments of gensky are missing. Needed: gensky MONTH DAY TIME, or gensky -ang "
              "ALTITUDE AZIMUTH, "
              "then the options.");
    EXPECT_EQ(refusal_of_rad("!gensky 6 21 12EST\n"),
              "r.rad:1: gensky: \"12EST\" is no time. Allowed: hours such as 9.5 or 9:30, with a plus sign "
              "for solar time; "
              "time zones are given by -m.");
    EXPECT_EQ(refusal_of_rad("!gensky 13 21 12\n"),
              "r.rad:1: gensky: 13 is not allowed. Allowed: whole numbers from 1 to 12. Needed: gensky MONTH "
              "DAY TIME, or "
              "gensky -ang ALTITUDE AZIMUTH, then the options.");
    EXPECT_EQ(refusal_of_rad("!gensky 6 21 12 -a north\n"),
              "r.rad:1: gensky: found \"north\" where a number is needed.");
    EXPECT_EQ(refusal_of_rad("!gensky 6 21 12 -y 2020\n"),
              "r.rad:1: the option \"-y\" of gensky is not supported. Allowed: -s, +s, -i, +i, -c, -u, -g, "
              "-t, -b, -B, -r, -R, "
              "-a, -o, -m.");
}

TEST(RadianceSky, LeavesOtherFunctionsToTheirWarning) {
    const radiance::Description description = describe_rad(
        "void brightfunc a 2 skybr mine.cal 0 3 2 1 1\nvoid brightfunc b 2 other skybright.cal 0 3 2 1 "
        "1\nvoid "
        "brightdata c 4 corr t.dat source.cal src_theta 0 0\n");
    for (const radiance::Modifier& modifier : description.modifiers)
        EXPECT_FALSE(radiance::read_sky_pattern(modifier, description)) << modifier.name;
}

constexpr std::string_view kDome =
    "\nskyfunc glow skyglow 0 0 4 .9 .9 1.15 0\nskyglow source sky 0 0 4 0 0 1 180\nskyfunc glow groundglow "
    "0 0 4 1.4 "
    ".9 .6 0\ngroundglow source ground 0 0 4 0 0 -1 180\nvoid plastic m 0 0 5 .5 .5 .5 0 0\nm sphere s 0 0 4 "
    "0 0 0 1\n";

const Panorama& panorama_of(const SceneFile& file) {
    return *std::get<EnvironmentLight>(file.scene.lights.at(0).source).panorama;
}

/// Of the overcast sky L (1 + 2 z) / 3, which melts into the black ground at the horizon.
TEST(RadianceSky, AnOvercastSkyCastsItsLight) {
    const SceneFile file =
        read_rad("void brightfunc skyfunc 2 skybr skybright.cal 0 3 2 34.61 0" + std::string(kDome));
    EXPECT_TRUE(file.warnings.empty());
    const double zenith_cd_m2 = 179 * (0.265 * 0.9 + 0.670 * 0.9 + 0.065 * 1.15) * 34.61;
    double expected_lx = 0;
    constexpr int steps = 10'000;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps, weight = std::pow(z + 1.01, 10);
        expected_lx += 2 * kPi * z * zenith_cd_m2 * (1 + 2 * z) / 3 * weight / (weight + 1 / weight) / steps;
    }
    EXPECT_NEAR(expected_lx, 7.0 / 9 * kPi * zenith_cd_m2, 0.003 * expected_lx);
    EXPECT_NEAR(panorama_of(file).illuminance_lx({0, 0, 1}).luminance(), expected_lx, 1e-4 * expected_lx);
}

/// Both halves of the dome have their own colours.
TEST(RadianceSky, TheGroundHasItsBrightness) {
    const SceneFile file =
        read_rad("void brightfunc skyfunc 2 skybr skybright.cal 0 3 3 34.61 6.921" + std::string(kDome));
    const double ground_cd_m2 = 179 * (0.265 * 1.4 + 0.670 * 0.9 + 0.065 * 0.6) * 6.921;
    EXPECT_NEAR(panorama_of(file).luminance_cd_m2({0, 0, -1}).luminance(), ground_cd_m2, 1e-5 * ground_cd_m2);
}

TEST(RadianceSky, ABlackSkyIsNoLight) {
    const SceneFile file =
        read_rad("void brightfunc skyfunc 2 skybr skybright.cal 0 3 3 0 0" + std::string(kDome));
    EXPECT_TRUE(file.scene.lights.empty());
}

TEST(RadianceSky, IsLeftOutOfSurfaces) {
    const SceneFile file = read_rad(
        "void brightfunc skyfunc 2 skybr skybright.cal 0 3 3 34.61 6.921\nskyfunc glow g 0 0 4 1 1 1 0\ng "
        "polygon "
        "pane 0 0 9 0 0 0 1 0 0 1 1 0\n");
    EXPECT_EQ(warnings_of(file),
              std::vector<std::string>{
                  "lamp pane: the brightness of a sky by direction is left out; it is for sources."});
}

TEST(RadianceSky, RefusesWrongNumbers) {
    const auto refusal = [](const std::string& sky) {
        return refusal_of_rad("void brightfunc skyfunc " + sky + std::string(kDome));
    };
    EXPECT_EQ(refusal("2 skybr skybright.cal 0 2 2 34"),
              "r.rad:1: brightfunc skyfunc: skybr needs 3 numbers here, but 2 were found.");
    EXPECT_EQ(refusal("2 skybr skybright.cal 0 3 1 34 5"),
              "r.rad:1: brightfunc skyfunc: skybr needs 7 numbers here, but 3 were found.");
    EXPECT_EQ(
        refusal("2 skybr skybright.cal 0 3 5 34 5"),
        "r.rad:1: brightfunc skyfunc: the kind of sky 5 is not allowed. Allowed: 1 (clear), 2 (overcast), 3 "
        "(uniform), 4 (intermediate).");
    EXPECT_EQ(refusal("2 skybr skybright.cal 0 7 1 34 5 1 0 0 0"),
              "r.rad:1: brightfunc skyfunc: the direction of the sun is 0 0 0. Allowed: any other.");
    EXPECT_EQ(refusal("2 skybright perezlum.cal 0 3 1 34 5"),
              "r.rad:1: brightfunc skyfunc: skybright needs 10 numbers here, but 3 were found.");
    EXPECT_EQ(refusal("3 skybr skybright.cal all 0 3 2 34 5"),
              "r.rad:1: brightfunc skyfunc: the texts behind the file are not all transforms.");
}

}  // namespace
}  // namespace stilb::io
