// Path tracing flattened by first shot, against path tracing as it is.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/mirror.h"
#include "materials/phong.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// Of flat surfaces, diffuse and glossy.
Scene phong_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, Phong{{{0.5, 0.4, 0.3}}, Rgb::grey(0.2), 8});
    add_object(scene, Box{{2, 1, 0}, {2.6, 1.6, 1}}, Phong{Rgb::grey(0.3), Rgb::grey(0.4), 20});
    add_object(scene, Box{{0.5, 2, 0}, {1.2, 2.6, 0.6}}, diffuse(0.7));
    add_point_light(scene, {3.2, 2.4, 2}, {{100, 80, 60}});
    add_point_light(scene, {0.8, 0.9, 2.2}, {{40, 60, 80}});
    return scene;
}

/// The same with a light that is not replaced, and with one that shines by a mirror.
Scene mirror_room() {
    Scene scene = phong_room();
    add_area_light(scene, Rectangle{{0.2, 0.2, 2.79}, {0, 2.6, 0}, {3.6, 0, 0}}, Rgb::grey(20), diffuse(0.5));
    add_area_light(scene, Rectangle{{3, 0.5, 1.6}, {0, 0.2, 0}, {0.2, 0, 0}}, Rgb::grey(1000));
    add_object(scene, Rectangle{{2.5, 0.3, 0.3}, {1, 0, 0}, {0, 0.8, 0}}, Mirror{Rgb::grey(0.9)});
    return scene;
}

std::vector<Sensor> sensors() {
    return {Sensor{"desk", Grid{{0.3, 0.3, 0.8}, {3.4, 0, 0}, {0, 2.4, 0}, {3, 2}, kUp}},
            {"sights", Luminance{{LineOfSight{{0.3, 0.3, 1.5}, normalized(Vec3{2, 1, -0.8})},
                                  LineOfSight{{2, 1.5, 1.5}, normalized(Vec3{1, 0.3, 0.7})},
                                  EmergentRay{{3, 2, 0}, kUp, normalized(Vec3{0.3, -0.5, 1})}}}}};
}

RunOptions path_options(std::uint64_t paths, std::optional<estimators::FirstShotVariant> variant = {},
                        std::optional<double> patch_m = {}) {
    RunOptions options;
    options.method = "path";
    options.paths = paths;
    options.patches.first_shot.variant = variant;
    options.patch_m = patch_m;
    return options;
}

void expect_agreement(const Scene& scene, const std::vector<Sensor>& measured, const RunOptions& flattened,
                      std::uint64_t seed) {
    const RunResult plain = measure(scene, measured, path_options(1 << 15));
    RunOptions options = flattened;
    options.seed = seed;
    const RunResult flat = measure(scene, measured, options);
    std::size_t readings = 0;
    for (const Sensor& sensor : measured) readings += sensor.size();
    const double threshold = statistics::sidak_threshold_z(0.001, readings);
    for (std::size_t s = 0; s < measured.size(); ++s) {
        for (std::size_t j = 0; j < measured[s].size(); ++j) {
            const statistics::Estimate &a = plain.sensors[s].readings[j].estimate,
                                       &b = flat.sensors[s].readings[j].estimate;
            EXPECT_LT(std::abs(statistics::equivalent_z(z_score(a, b), 31)), threshold)
                << measured[s].name << ' ' << j << ": " << a.value << ", " << b.value;
            EXPECT_LT(b.standard_error, 0.02 * b.value) << measured[s].name << ' ' << j;
        }
    }
}

/// Point-like lights are exact on the fly, so patches on flat surfaces leave no bias.
TEST(PathFirstShot, OnTheFlyIsPathTracing) {
    expect_agreement(phong_room(), sensors(),
                     path_options(1 << 14, estimators::FirstShotVariant::on_the_fly, 1), 2);
}

/// Lights that stay, and light that comes by mirrors, are found by paths as ever. At points: a line of sight
/// sees area lights by the same few points on them in every path.
TEST(PathFirstShot, LosesNoOtherLight) {
    const std::vector<Sensor> points{sensors().front()};
    const RunOptions options = path_options(1 << 14, estimators::FirstShotVariant::on_the_fly, 1);
    expect_agreement(mirror_room(), points, options, 2);
    const RunResult result =
        measure(mirror_room(), points, path_options(1 << 10, estimators::FirstShotVariant::incoming, 1));
    std::vector<bool> replaced;
    for (const estimators::FirstShotLight& light : result.patches->lights)
        replaced.push_back(light.is_replaced);
    EXPECT_EQ(replaced, (std::vector{true, true, false, true}));
}

TEST(PathFirstShot, ApproachesPathTracingAsPatchesShrink) {
    const Scene scene = phong_room();
    Luminance all_around;
    for (int i = 0; i < 64; ++i) {  // by the golden section
        const double z = (i + 0.5) / 32 - 1, turn = 2 * std::numbers::pi * i / std::numbers::phi;
        const double r = std::sqrt(1 - z * z);
        all_around.sights.emplace_back(
            LineOfSight{{2.1, 1.9, 1.3}, {r * std::cos(turn), r * std::sin(turn), z}});
    }
    const std::vector<Sensor> measured{
        Sensor{"desk", Grid{{0.3, 0.3, 0.8}, {3.4, 0, 0}, {0, 2.4, 0}, {6, 4}, kUp}}, {"around", all_around}};
    const RunResult exact = measure(scene, measured, path_options(1 << 13));
    for (const estimators::FirstShotVariant variant :
         {estimators::FirstShotVariant::classical, estimators::FirstShotVariant::diffuse,
          estimators::FirstShotVariant::incoming}) {
        double before = 1;
        for (const double patch_m : {1., 0.15}) {
            const RunResult result = measure(scene, measured, path_options(1 << 12, variant, patch_m));
            double error = 0;
            for (std::size_t s = 0; s < measured.size(); ++s) {
                const double expected = exact.sensors[s].summary.mean.value;
                error = std::max(error, std::abs(result.sensors[s].summary.mean.value / expected - 1));
            }
            EXPECT_LT(error, before) << name_of(variant) << ", " << patch_m;
            before = error;
        }
        EXPECT_LT(before, 0.01) << name_of(variant);
    }
}

TEST(PathFirstShot, IsNoneUnlessAskedFor) {
    const Scene scene = phong_room();
    const RunResult plain = measure(scene, sensors(), path_options(1 << 10));
    const RunResult none =
        measure(scene, sensors(), path_options(1 << 10, estimators::FirstShotVariant::none));
    EXPECT_FALSE(plain.patches);
    EXPECT_FALSE(none.patches);
    EXPECT_TRUE(plain.warnings.empty());
    for (std::size_t s = 0; s < 2; ++s)
        EXPECT_EQ(plain.sensors[s].summary.mean, none.sensors[s].summary.mean);
}

TEST(PathFirstShot, SaysThatItIsBiased) {
    const RunResult result =
        measure(phong_room(), sensors(), path_options(1 << 10, estimators::FirstShotVariant::incoming, 0.5));
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_NE(result.warnings[0].text.find("biased by patches of 0.5 m"), std::string::npos)
        << result.warnings[0].text;
    EXPECT_EQ(result.patches->first_shot, estimators::FirstShotVariant::incoming);
}

TEST(PathFirstShot, ThreadsChangeNothing) {
    RunOptions options = path_options(1 << 11, estimators::FirstShotVariant::diffuse, 0.5);
    const RunResult once = measure(mirror_room(), sensors(), options);
    for (const int threads : {1, 3}) {
        options.threads = threads;
        const RunResult again = measure(mirror_room(), sensors(), options);
        for (std::size_t s = 0; s < 2; ++s) {
            for (std::size_t j = 0; j < once.sensors[s].readings.size(); ++j) {
                EXPECT_EQ(again.sensors[s].readings[j].estimate, once.sensors[s].readings[j].estimate);
            }
        }
    }
}

/// Emission that is seen stays what it is.
TEST(PathFirstShot, PicturesShowTheLights) {
    const Sensor camera{"camera",
                        Camera{{0.3, 0.3, 1.5}, {2.8, 1, 1.6}, kUp, 70, {24, 16}, Projection::perspective}};
    RunOptions options = path_options(256);
    const Scene scene = mirror_room();
    const RenderResult plain = render(scene, camera, options);
    options.patches.first_shot.variant = estimators::FirstShotVariant::incoming;
    options.patch_m = 0.15;
    const RenderResult flat = render(scene, camera, options);
    EXPECT_NEAR(flat.mean_luminance_cd_m2, plain.mean_luminance_cd_m2, 0.01 * plain.mean_luminance_cd_m2);
    EXPECT_LT(flat.mean_standard_error_cd_m2, plain.mean_standard_error_cd_m2);
    EXPECT_TRUE(flat.patches);
}

}  // namespace
}  // namespace stilb::run
