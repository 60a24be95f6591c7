// Ray bundles against exact values and against path tracing, as patches shrink.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/diffuse.h"
#include "materials/phong.h"
#include "materials/rough_conductor.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "stilb/error.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// A cube of 4 m with 10 klm at its centre.
Scene lamp_in_bundle_cube(double reflectance) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 4}}, Diffuse{Rgb::grey(reflectance)});
    add_point_light(scene, {2, 2, 2}, Rgb::grey(10'000 / (4 * std::numbers::pi)));
    return scene;
}

/// A room of all that reflects diffusely and not, with a small and a large light.
Scene glossy_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, Diffuse{{{0.7, 0.6, 0.4}}});
    add_object(scene, Box{{2, 1, 0}, {2.6, 1.6, 1}}, Phong{Rgb::grey(0.3), Rgb::grey(0.4), 5});
    add_object(scene, Box{{0.5, 2, 0}, {1.2, 2.6, 0.6}}, RoughConductor({Rgb::grey(0.8), 0.4}));
    add_area_light(scene, Rectangle{{1, 0.6, 2.7}, {0, 1.6, 0}, {2, 0, 0}}, Rgb::grey(100));
    add_point_light(scene, {3.2, 2.4, 2}, Rgb::grey(100));
    return scene;
}

Sensor points(std::vector<MeasuringPoint> places) { return {"points", IlluminancePoints{std::move(places)}}; }

Sensor sights(std::vector<Measurand> lines) { return {"sights", Luminance{std::move(lines)}}; }

RunOptions bundle_options(double patch_m, std::uint64_t steps) {
    RunOptions options;
    options.method = "ray-bundle";
    options.paths = steps;
    options.replicates = 8;
    options.patch_m = patch_m;
    return options;
}

statistics::Estimate measured(const Scene& scene, const Sensor& sensor, const RunOptions& options,
                              std::size_t reading) {
    return measure(scene, {&sensor, 1}, options).sensors[0].readings[reading].estimate;
}

TEST(RayBundle, LightsACubeAsComputed) {
    const Sensor floor = points({{{2, 2, 0}, kUp}, {{0.5, 0.5, 0}, kUp}});
    const RunResult result = measure(lamp_in_bundle_cube(0.8), {&floor, 1}, bundle_options(0.5, 1 << 12));
    const auto direct = [](double x, double y) {
        const double squared = 4 + (x - 2) * (x - 2) + (y - 2) * (y - 2);
        return 10'000 / (4 * std::numbers::pi) * 2 / std::pow(squared, 1.5);
    };
    const auto& readings = result.sensors[0].readings;
    EXPECT_NEAR(readings[0].estimate.value - direct(2, 2), 430.95, 0.01 * 430.95);
    EXPECT_NEAR(readings[1].estimate.value - direct(0.5, 0.5), 403.10, 0.01 * 403.10);
    EXPECT_LT(readings[0].estimate.standard_error, 0.005 * 430.95);
}

/// One direction and one axis have finite variance at a reflectance of 0.5, too.
TEST(RayBundle, AllDirectionsHaveTheSameMean) {
    const Scene scene = lamp_in_bundle_cube(0.5);
    const Sensor floor = points({{{1, 1.3, 0}, kUp}});
    std::vector<statistics::Estimate> estimates;
    for (const estimators::BundleDirections directions :
         {estimators::BundleDirections::single, estimators::BundleDirections::pair,
          estimators::BundleDirections::frame}) {
        RunOptions options = bundle_options(1, 1 << 13);
        options.patches.directions = directions;
        options.replicates = 32;
        estimates.push_back(measured(scene, floor, options, 0));
        EXPECT_LT(estimates.back().standard_error, 0.005 * estimates.back().value) << name_of(directions);
    }
    const double threshold = statistics::sidak_threshold_z(0.001, 3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(std::abs(statistics::equivalent_z(z_score(estimates[i], estimates[(i + 1) % 3]), 31)),
                  threshold)
            << estimates[i].value << ' ' << estimates[(i + 1) % 3].value;
    }
}

TEST(RayBundle, EveryFirstShotApproachesPathTracing) {
    const Scene scene = glossy_room();
    const Sensor sensor = sights({LineOfSight{{0.3, 0.3, 1.5}, normalized(Vec3{2, 1, -0.8})},
                                  LineOfSight{{0.3, 0.3, 1.5}, normalized(Vec3{1, 2.2, -1.1})},
                                  LineOfSight{{2, 1.5, 1.5}, normalized(Vec3{1, 0.3, -1})}});
    RunOptions path;
    path.method = "path";
    path.error = 0.01;
    const RunResult exact = measure(scene, {&sensor, 1}, path);
    for (const estimators::FirstShotVariant variant :
         {estimators::FirstShotVariant::classical, estimators::FirstShotVariant::diffuse,
          estimators::FirstShotVariant::incoming, estimators::FirstShotVariant::on_the_fly}) {
        // Shadow rays at every crossing take their time.
        const bool on_the_fly = variant == estimators::FirstShotVariant::on_the_fly;
        RunOptions options = bundle_options(on_the_fly ? 0.35 * coarser(2) : 0.35, 64);
        options.patches.first_shot.variant = variant;
        const double tolerance = 0.05;
        const RunResult result = measure(scene, {&sensor, 1}, options);
        for (std::size_t j = 0; j < 3; ++j) {
            const double expected = exact.sensors[0].readings[j].estimate.value;
            EXPECT_NEAR(result.sensors[0].readings[j].estimate.value, expected, tolerance * expected)
                << name_of(variant) << ' ' << j;
        }
    }
}

/// A lamp in a glossy plate: first shot that is not stored draws points on the lamp, which is noise.
TEST(RayBundle, HighlightsHaveErrorBarsThatHold) {
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, Phong{{}, Rgb::grey(0.6), 200});
    add_area_light(scene, Sphere{{2, 2.5, 1.5}, 0.2}, Rgb::grey(1000));
    Sensor sensor = sights({LineOfSight{{2, 0.5, 1.5}, normalized({0, 1.05, -1.5})}});
    RunOptions reference;
    reference.method = "path";
    reference.error = 0.002;
    const statistics::Estimate exact = measured(scene, sensor, reference, 0);
    for (const auto variant :
         {estimators::FirstShotVariant::diffuse, estimators::FirstShotVariant::on_the_fly}) {
        RunOptions options = bundle_options(0.5, 256);
        options.patches.first_shot.variant = variant;
        const statistics::Estimate found = measured(scene, sensor, options, 0);
        const double error = std::hypot(found.standard_error, exact.standard_error);
        EXPECT_LT(std::abs(found.value - exact.value), 4.5 * error) << name_of(variant);
        EXPECT_GT(found.standard_error, 0) << name_of(variant);
        EXPECT_LT(found.standard_error, 0.02 * exact.value) << name_of(variant);
    }
}

TEST(RayBundle, ThreadsAndRepetitionsChangeNothing) {
    const Scene scene = glossy_room();
    const Sensor floor = points({{{1, 1.3, 0}, kUp}, {{3, 1.3, 0.8}, kUp}});
    RunOptions options = bundle_options(0.5, 256);
    const statistics::Estimate once = measured(scene, floor, options, 1);
    for (const int threads : {1, 2, 3}) {
        options.threads = threads;
        const statistics::Estimate again = measured(scene, floor, options, 1);
        EXPECT_EQ(again.value, once.value);
        EXPECT_EQ(again.standard_error, once.standard_error);
    }
}

/// Patches of this size make the room 1.4 % darker, those of 0.15 m 0.7 %.
TEST(RayBundle, PicturesShowWhatMetersMeasure) {
    const Scene scene = glossy_room();
    const Sensor camera{"camera",
                        Camera{{0.3, 0.3, 1.5}, {2.3, 1.3, 0.7}, kUp, 70, {24, 16}, Projection::perspective}};
    RunOptions options = bundle_options(0.35, 16);
    const RenderResult bundle = render(scene, camera, options);
    options.method = "path";
    options.paths = 256;
    const RenderResult path = render(scene, camera, options);
    EXPECT_NEAR(bundle.mean_luminance_cd_m2, path.mean_luminance_cd_m2, 0.02 * path.mean_luminance_cd_m2);
    EXPECT_LT(bundle.mean_standard_error_cd_m2, 0.05 * bundle.mean_luminance_cd_m2);
}

TEST(RayBundle, ReportsPatchesAndLights) {
    const Sensor floor = points({{{1, 1.3, 0}, kUp}});
    const RunResult result = measure(glossy_room(), {&floor, 1}, bundle_options(0.5, 64));
    ASSERT_TRUE(result.patches);
    EXPECT_EQ(result.patches->first_shot, estimators::FirstShotVariant::incoming);
    EXPECT_EQ(result.patches->size_m, 0.5);
    EXPECT_TRUE(result.patches->resolution);
    ASSERT_EQ(result.patches->lights.size(), 2U);
    for (const estimators::FirstShotLight& light : result.patches->lights)
        EXPECT_TRUE(light.is_replaced) << light.why;
    EXPECT_GT(result.patches->lights[0].samples, 4U);
    EXPECT_EQ(result.patches->lights[1].samples, 1U);
    EXPECT_GT(result.patches->bytes_per_patch, 0);
    EXPECT_GT(result.patches->set_up_s, 0);
}

TEST(RayBundle, RefusesToLimitReflections) {
    RunOptions options = bundle_options(1, 16);
    options.bounces = 2;
    const Sensor floor = points({{{1, 1.3, 0}, kUp}});
    EXPECT_THROW(measure(lamp_in_bundle_cube(0.5), {&floor, 1}, options), InputError);
}

TEST(RayBundle, RefusesPointsThatNothingBringsToPatches) {
    RunOptions options = bundle_options(1, 16);
    options.patches.first_shot.variant = estimators::FirstShotVariant::none;
    const Sensor floor = points({{{1, 1.3, 0}, kUp}});
    EXPECT_THROW(measure(lamp_in_bundle_cube(0.5), {&floor, 1}, options), InputError);
}

}  // namespace
}  // namespace stilb::run
