// Glass that absorbs, against exact values, by every method that measures luminance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "io/scene/scene_file.h"
#include "materials/dielectric.h"
#include "run/run.h"

namespace stilb {
namespace {

constexpr double kIor = 1.5, kDegree = std::numbers::pi / 180;
constexpr std::array<double, 3> kAngles_deg{0, 40, 70};
/// Ways begin a little off the faces, here by 2 micrometres.
constexpr double kLifts = 2e-4;
/// The share of the light that is not absorbed over 5 cm.
const Rgb kColor{{0.5, 0.8, 1}};

/// A slab of 10 cm under an even sky, seen from above.
const std::string kSlab =
    "[materials.glass]\ntype = \"glass\"\nior = 1.5\ncolor = [0.5, 0.8, 1]\ndistance = 0.05\n"
    "[lights.sky]\ntype = \"environment\"\nluminance = 100\n"
    "[objects.slab]\nshape = \"box\"\nmin = [-1, -1, 0]\nmax = [1, 1, 0.1]\nmaterial = \"glass\"\n";

/// The share of the sky's light that comes from a slab of this thickness: reflected at its top, and passed
/// through it, with all reflections inside. Every face takes the light as unpolarised, as Stilb does.
Rgb seen_share(double cosine, double thickness_m) {
    const double r = materials::fresnel_reflectance(cosine, kIor).unpolarised();
    const double way_m = thickness_m / materials::refracted_cosine(cosine, kIor);
    Rgb share;
    for (std::size_t b = 0; b < kBands; ++b) {
        const double left = std::pow(kColor[b], way_m / 0.05);
        const double through = (1 - r) * (1 - r) * left / (1 - r * r * left * left);
        share[b] = r + r * left * through + through;
    }
    return share;
}

class ColouredGlass : public testing::TestWithParam<const char*> {
  protected:
    void expect_slab(std::string text, double thickness_m) const {
        for (const double angle_deg : kAngles_deg) {
            const double x = std::sin(angle_deg * kDegree), z = std::cos(angle_deg * kDegree);
            text += fmt::format(
                "[sensors.\"{}\"]\ntype = \"luminance\"\nposition = [{}, 0, {}]\ndirection = [{}, 0, {}]\n",
                angle_deg, x, z + 0.1, -x, -z);
        }
        const io::SceneFile file = io::read_scene(text, "scene.toml", "");
        EXPECT_TRUE(file.warnings.empty());
        RunOptions options;
        options.method = GetParam();
        options.error = 0.004;
        options.time_s = 60;
        const RunResult result = run::measure(file.scene, file.sensors, options);
        for (std::size_t i = 0; i < kAngles_deg.size(); ++i) {
            const run::Reading& reading = result.sensors[i].readings[0];
            const Rgb share = seen_share(std::cos(kAngles_deg[i] * kDegree), thickness_m);
            const double error = reading.estimate.standard_error, exact = 100 * share.luminance();
            EXPECT_NEAR(reading.estimate.value, exact, 4.5 * error + kLifts * exact)
                << kAngles_deg[i] << " degrees, " << result.technique;
            EXPECT_LT(error, 0.003 * exact);
            for (std::size_t b = 0; b < kBands; ++b)
                EXPECT_NEAR(reading.rgb[b], 100 * share[b], 9 * error + kLifts * exact) << "band " << b;
        }
    }
};

TEST_P(ColouredGlass, SlabsLeaveWhatBeersLawLeaves) { expect_slab(kSlab, 0.1); }

/// The faces of a clear slab inside, of the same refractive index, know the glass around it.
TEST_P(ColouredGlass, ClearGlassInsideLeavesTheRest) {
    expect_slab(kSlab +
                    "[materials.clear]\ntype = \"glass\"\nior = 1.5\n[objects.inside]\nshape = \"box\"\n"
                    "min = [-0.9, -0.9, 0.02]\nmax = [0.9, 0.9, 0.06]\nmaterial = \"clear\"\n",
                0.06);
}

INSTANTIATE_TEST_SUITE_P(Methods, ColouredGlass,
                         testing::Values("auto", "path", "light-paths", "guided", "double-local"),
                         [](const auto& method) {
                             std::string name;
                             for (const char letter : std::string(method.param))
                                 if (letter != '-') name += letter;
                             return name;
                         });

TEST(GlassInScenes, ThingsInColouredGlassAreNamed) {
    const io::SceneFile file = io::read_scene(kSlab +
                                                  "[materials.black]\ntype = \"black\"\n[objects.ball]\n"
                                                  "shape = \"sphere\"\ncenter = [0, 0, 0.05]\nradius = 0.01\n"
                                                  "material = \"black\"\n",
                                              "scene.toml", "");
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_EQ(file.warnings[0].text,
              "object \"ball\": this lies in glass that has a color. Light that passes between it and other "
              "things in there, or a frosted face, is not absorbed on this way.");
}

}  // namespace
}  // namespace stilb
