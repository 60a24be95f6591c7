// Surfaces that let light through, against exact values, by every method that has them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/coarser.h"

namespace stilb {
namespace {

constexpr double kPi = std::numbers::pi;
/// Shares of the light: reflected, transmitted diffusely, and straight.
constexpr double kReflected = 0.4, kDiffuse = 0.35, kStraight = 0.15;

struct Measured {
    statistics::Estimate value;
    std::string technique;
};

std::vector<Measured> measured(const std::string& text, const std::string& method, double error) {
    const io::SceneFile file = io::read_scene(text, "scene.toml", "");
    RunOptions options;
    options.method = method;
    options.error = 2 * error;  // half of an interval
    options.patch_m = 1;        // of methods that have patches
    options.time_s = 60;
    const RunResult result = run::measure(file.scene, file.sensors, options);
    std::vector<Measured> all;
    for (const SensorResult& sensor : result.sensors)
        all.push_back({sensor.readings[0].estimate, result.technique});
    return all;
}

void expect_exact(const Measured& one, double exact, double error, const std::string& what) {
    EXPECT_NEAR(one.value.value, exact, 4.5 * one.value.standard_error + 1e-9 * exact)
        << what << ", " << one.technique;
    EXPECT_LT(one.value.standard_error, error * exact) << what << ": the comparison tells something";
}

class Translucent : public testing::TestWithParam<const char*> {
  protected:
    /// Local estimation has an infinite variance in corners.
    double error() const { return coarser() * (GetParam() == std::string("local") ? 0.01 : 0.004); }
    bool measures_luminance() const { return GetParam() != std::string("local"); }
};

/// Under an even sky everything that keeps all light is invisible, on both sides.
TEST_P(Translucent, SheetsThatKeepAllLightAreInvisibleUnderAnEvenSky) {
    std::string text =
        "[materials.sheet]\ntype = \"translucent\"\nreflectance = 0.5\ntransmittance = 0.3\n"
        "specular_transmittance = 0.2\n"
        "[lights.sky]\ntype = \"environment\"\nluminance = 100\n"
        "[objects.box]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [2, 3, 1]\nmaterial = \"sheet\"\n"
        "[objects.sheet]\nshape = \"rectangle\"\ncorner = [-1, -1, 2]\nedge_u = [3, 0, 0]\nedge_v = [0, 4, "
        "0]\n"
        "material = \"sheet\"\n"
        "[sensors.inside]\ntype = \"illuminance\"\nposition = [0.7, 1, 0.3]\nnormal = [0.6, 0, 0.8]\n"
        "[sensors.between]\ntype = \"illuminance\"\nposition = [1.2, 1.5, 1.5]\nnormal = [0, 0.6, -0.8]\n";
    const double exact_lx = 100 * kPi, error = this->error();
    if (measures_luminance())
        text +=
            "[sensors.seen]\ntype = \"luminance\"\nposition = [1, 1, 5]\ndirection = [0.1, 0.2, -1]\n"
            "[sensors.seen_inside]\ntype = \"luminance\"\nposition = [1, 1, 0.5]\ndirection = [1, 0.5, "
            "0.1]\n";
    const std::vector<Measured> all = measured(text, GetParam(), error);
    for (std::size_t i = 0; i < all.size(); ++i)
        expect_exact(all[i], i < 2 ? exact_lx : 100, error, fmt::format("sensor {}", i));
}

/// So is frosted glass, a solid and a sheet, whose facets send on all light.
TEST_P(Translucent, FrostedGlassIsInvisibleUnderAnEvenSky) {
    std::string text =
        "[materials.solid]\ntype = \"frosted\"\nior = 1.5\nroughness = 0.4\n"
        "[materials.sheet]\ntype = \"frosted\"\nior = 1.6\nroughness = 0.7\nthin = true\n"
        "[lights.sky]\ntype = \"environment\"\nluminance = 100\n"
        "[objects.box]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [2, 3, 1]\nmaterial = \"solid\"\n"
        "[objects.sheet]\nshape = \"rectangle\"\ncorner = [-1, -1, 2]\nedge_u = [3, 0, 0]\nedge_v = [0, 4, "
        "0]\n"
        "material = \"sheet\"\n"
        "[sensors.between]\ntype = \"illuminance\"\nposition = [1.2, 1.5, 1.5]\nnormal = [0, 0.6, -0.8]\n";
    const double error = (GetParam() == std::string("double-local") ? 6 : 2) * this->error();
    if (measures_luminance())
        text += "[sensors.seen]\ntype = \"luminance\"\nposition = [1, 1, 1.8]\ndirection = [0.1, 0.2, -1]\n";
    const std::vector<Measured> all = measured(text, GetParam(), error);
    for (std::size_t i = 0; i < all.size(); ++i)
        expect_exact(all[i], i == 0 ? 100 * kPi : 100, error, fmt::format("sensor {}", i));
}

/// Under an even sky a fabric is as bright as the light that it reflects, scatters and lets pass straight.
TEST_P(Translucent, FabricsUnderAnEvenSkyDarkenTowardsGrazingAngles) {
    if (!measures_luminance()) return;
    std::string text =
        "[materials.fabric]\ntype = \"fabric\"\nopenness = 0.3\ntransmittance = 0.4\nreflectance = 0.25\n"
        "[lights.sky]\ntype = \"environment\"\nluminance = 100\n"
        "[objects.sheet]\nshape = \"rectangle\"\ncorner = [-1, -1, 0]\nedge_u = [2, 0, 0]\nedge_v = [0, 2, "
        "0]\n"
        "material = \"fabric\"\n";
    constexpr double degree = kPi / 180;
    // The straight part [Kotey, Wright, Collins 2009], computed apart; it ends at 67.7 degrees.
    const std::array<std::array<double, 2>, 4> straight{
        {{0, 0.3}, {30, 0.2573506145652811}, {60, 0.11040179505673894}, {70, 0}}};
    for (const double side : {1., -1.}) {
        for (const auto& [angle_deg, share] : straight) {
            const Vec3 away{std::sin(angle_deg * degree), 0, side * std::cos(angle_deg * degree)};
            text += fmt::format(
                "[sensors.\"{} {}\"]\ntype = \"luminance\"\nposition = [{}, 0, {}]\ndirection = [{}, 0, "
                "{}]\n",
                side, angle_deg, away.x, away.z, -away.x, -away.z);
        }
    }
    const std::vector<Measured> all = measured(text, GetParam(), error());
    ASSERT_EQ(all.size(), 2 * straight.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        expect_exact(all[i], 100 * (0.25 + 0.4 - 0.3 + straight[i % straight.size()][1]), error(),
                     fmt::format("sensor {}", i));
}

/// A lamp in the middle of a shell in the dark, which is darker outside. Inside, E = E0 / (1 - reflectance)
/// with E0 = I / r^2. Outside, the shell's luminance is what it transmits of that and what passes straight of
/// the luminance behind it, and so its illuminance at the distance d is (r / d)^2 pi times as much; the
/// lamp's own light passes straight.
TEST_P(Translucent, ShellsAroundALampLightWhatIsOutside) {
    const double r = 0.5, d = 2, intensity = 1000 / (4 * kPi),
                 inside = intensity / (r * r) / (1 - kReflected);
    // An exact sphere has no guess.
    const double error = (GetParam() == std::string("guided") ? 4 : 1) * this->error();
    std::string text = fmt::format(
        "[materials.shell]\ntype = \"translucent\"\nreflectance = 0.05\ntransmittance = {1}\n"
        "specular_transmittance = {2}\nback = {{ reflectance = {0} }}\n[objects.shell]\nshape = "
        "\"sphere\"\ncenter = [0, 0, 0]\nradius = "
        "0.5\nmaterial = \"shell\"\n"
        "[lights.lamp]\ntype = \"point\"\nposition = [0, 0, 0]\nflux = 1000\n"
        "[sensors.outside]\ntype = \"illuminance\"\nposition = [0, 0, 2]\nnormal = [0, 0, -1]\n",
        kReflected, kDiffuse, kStraight);
    if (measures_luminance())
        text +=
            "[sensors.shell]\ntype = \"luminance\"\nposition = [0, 0, 2]\ndirection = [0.05, 0.02, -1]\n"
            "[sensors.wall]\ntype = \"luminance\"\nposition = [0, 0, 0.2]\ndirection = [0.3, 0.2, 1]\n";
    const std::vector<Measured> all = measured(text, GetParam(), error);
    const double luminance = (kDiffuse + kStraight * kReflected) * inside / kPi;
    expect_exact(all[0], (r / d) * (r / d) * kPi * luminance + kStraight * intensity / (d * d), error,
                 "outside");
    if (!measures_luminance()) return;
    expect_exact(all[1], luminance, error, "seen from outside");
    expect_exact(all[2], kReflected * inside / kPi, error, "seen from inside");
}

INSTANTIATE_TEST_SUITE_P(Methods, Translucent,
                         testing::Values("auto", "path", "light-paths", "guided", "local", "double-local"),
                         [](const auto& method) {
                             std::string name;
                             for (const char letter : std::string(method.param))
                                 if (letter != '-') name += letter;
                             return name;
                         });

class Backs : public testing::TestWithParam<const char*> {};

/// A wall between two rooms lights each of them as a wall that is on both sides what it is on this one.
TEST_P(Backs, LightTheirOwnRoom) {
    const auto rooms = [&](const std::string& wall) {
        return "[materials.rest]\ntype = \"diffuse\"\nreflectance = 0.6\n[materials.wall]\n" + wall +
               "\n[objects.rooms]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [6, 4, 3]\nmaterial = \"rest\"\n"
               "[objects.wall]\nshape = \"rectangle\"\ncorner = [3, 0, 0]\nedge_u = [0, 4, 0]\n"
               "edge_v = [0, 0, 3]\nmaterial = \"wall\"\n"
               "[lights.back]\ntype = \"point\"\nposition = [1.5, 2, 2]\nflux = 3000\n"
               "[lights.front]\ntype = \"point\"\nposition = [4.5, 2, 2]\nflux = 1000\n"
               "[sensors.back]\ntype = \"illuminance\"\nposition = [2, 2, 1.5]\nnormal = [1, 0, 0]\n"
               "[sensors.front]\ntype = \"illuminance\"\nposition = [4, 2, 1.5]\nnormal = [-1, 0, 0]\n";
    };
    const std::string method = GetParam(), front = "type = \"diffuse\"\nreflectance = [0.2, 0.1, 0.3]";
    const bool is_diffuse_only = method == "radiosity" || method == "particles";
    const std::string type = is_diffuse_only ? "diffuse" : "phong";
    const std::vector<std::string> keys =
        is_diffuse_only ? std::vector<std::string>{"reflectance = 0.8"}
                        : std::vector<std::string>{"diffuse = 0.5", "specular = 0.3", "exponent = 5"};
    const bool has_patches = is_diffuse_only || method == "ray-bundle";
    // Where patches are a metre long, radiosity is not sure of more.
    const double error = method == "radiosity" ? 0.1 : has_patches ? 0.02 : 0.004 * coarser();
    const std::string back = fmt::format("type = \"{}\"\n{}", type, fmt::join(keys, "\n"));
    const auto both =
        measured(rooms(fmt::format("{}\nback = {{ type = \"{}\", {} }}", front, type, fmt::join(keys, ", "))),
                 method, error);
    const auto as_back = measured(rooms(back), method, error),
               as_front = measured(rooms(front), method, error);
    const std::array alone{as_back[0], as_front[1]};
    for (std::size_t i = 0; i < alone.size(); ++i) {
        const double error_lx = std::hypot(alone[i].value.standard_error, both[i].value.standard_error);
        EXPECT_NEAR(both[i].value.value, alone[i].value.value, 4.5 * error_lx)
            << i << ", " << both[i].technique;
        EXPECT_LT(error_lx, 5 * error * both[i].value.value);
    }
    EXPECT_GT(as_back[0].value.value, 1.5 * as_front[0].value.value)
        << "more than what the comparison allows";
}

INSTANTIATE_TEST_SUITE_P(Methods, Backs,
                         testing::Values("auto", "path", "light-paths", "guided", "double-local",
                                         "ray-bundle", "radiosity", "particles"),
                         [](const auto& method) {
                             std::string name;
                             for (const char letter : std::string(method.param))
                                 if (letter != '-') name += letter;
                             return name;
                         });

TEST(Transmission, IsRefusedByMethodsWithPatches) {
    const std::string text =
        "[materials.shell]\ntype = \"translucent\"\nreflectance = 0.4\ntransmittance = 0.4\n"
        "[objects.ball]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.5\nmaterial = \"shell\"\n"
        "[lights.lamp]\ntype = \"point\"\nposition = [0, 0, 0]\nflux = 1000\n"
        "[sensors.outside]\ntype = \"illuminance\"\nposition = [0, 0, 2]\nnormal = [0, 0, -1]\n";
    for (const char* method : {"ray-bundle", "radiosity", "particles"}) {
        try {
            measured(text, method, 0.1);
            ADD_FAILURE() << method;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find("object \"ball\""), std::string::npos) << message;
        }
    }
}

}  // namespace
}  // namespace stilb
