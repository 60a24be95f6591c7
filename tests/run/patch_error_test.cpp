// The patch error that methods on patches state is compared with the error that they really have.
#include <gtest/gtest.h>

#include <cmath>

#include "exact/sobolev.h"
#include "materials/black.h"
#include "run/run.h"
#include "run/solve.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kHalfSize_m = 15;
const exact::ParallelPlanes kPlanes{0.5, 0.7, 0.6, 0.4, 100};

Scene sobolevs_planes() {
    Scene scene;
    add_object(scene,
               Rectangle{{-kHalfSize_m, -kHalfSize_m, 0}, {2 * kHalfSize_m, 0, 0}, {0, 2 * kHalfSize_m, 0}},
               diffuse(kPlanes.reflectance_1));
    add_object(scene,
               Rectangle{{-kHalfSize_m, -kHalfSize_m, 1}, {0, 2 * kHalfSize_m, 0}, {2 * kHalfSize_m, 0, 0}},
               diffuse(kPlanes.reflectance_2));
    add_point_light(scene, {0, 0, kPlanes.distance_1_m}, Rgb::grey(kPlanes.intensity_cd));
    return scene;
}

RunOptions coarse_options(const std::string& method, double patch_m) {
    RunOptions options;
    options.method = method;
    options.patch_m = patch_m;
    options.paths = method == "particles" ? 1 << 18 : 1 << 10;
    return options;
}

class PatchError : public testing::TestWithParam<const char*> {};

/// Patches as large as the planes are apart make errors of many per cent.
TEST_P(PatchError, IsInTheIntervalsOfReadings) {
    const exact::SobolevProblem problem(kPlanes);
    std::vector<MeasuringPoint> points;
    for (const double radius : {0.3, 1., 2.}) points.push_back({{radius, 0, 0}, kUp});
    const Sensor sensor = point_sensor(points);
    for (const double patch_m : {2., 8.}) {
        const RunResult result =
            measure(sobolevs_planes(), {&sensor, 1}, coarse_options(GetParam(), patch_m));
        const SensorResult& readings = result.sensors[0];
        double largest = 0;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const double exact_lx = problem.illuminance_lx(exact::Plane::first, points[j].position.x);
            const statistics::Estimate& e = readings.readings[j].estimate;
            // One of so many 95 % intervals may miss by a little.
            EXPECT_LT(std::abs(e.value - exact_lx), 1.5 * (e.upper - e.lower) / 2)
                << patch_m << " m at " << points[j].position.x;
            EXPECT_GT(*readings.readings[j].patch_error, 0);
            largest = std::max(largest, std::abs(e.value / exact_lx - 1));
        }
        // It is not just a wide guess.
        EXPECT_GT(largest, 0.3 * *readings.patch_error) << patch_m;
        EXPECT_LT(largest, 3 * *readings.patch_error) << patch_m;
        ASSERT_FALSE(result.warnings.empty());
        EXPECT_NE(result.warnings.back().text.find("smaller patches"), std::string::npos)
            << result.warnings.back().text;
    }
}

TEST_P(PatchError, EndsARunThatCannotReachItsError) {
    const Sensor sensor = point_sensor({{{1, 0, 0}, kUp}});
    RunOptions options = coarse_options(GetParam(), 8);
    options.paths.reset();
    options.error = 0.01;
    const RunResult result = measure(sobolevs_planes(), {&sensor, 1}, options);
    EXPECT_EQ(result.stop_reason, StopReason::patches_too_coarse);
    EXPECT_FALSE(result.converged);
    EXPECT_GT(result.attained_error, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Methods, PatchError, testing::Values("radiosity", "ray-bundle", "particles"),
                         [](const auto& method) {
                             const std::string name = method.param;
                             return name.substr(0, name.find('-'));
                         });

/// In a shadow without any reflection the reading is exactly 0, by patches as well.
TEST(PatchErrorOfNothing, IsNothingInTheDark) {
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, Black{});
    add_object(scene, Rectangle{{0, 0, 1}, {2, 0, 0}, {0, 4, 0}}, Black{});
    add_point_light(scene, {1, 2, 2}, Rgb::grey(100));
    const Sensor grid{"floor", Grid{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {8, 2}, kUp}};
    const RunResult result = measure(scene, {&grid, 1}, coarse_options("ray-bundle", 0.5));
    const SensorResult& floor = result.sensors[0];
    EXPECT_EQ(floor.summary.minimum.value, 0);
    EXPECT_EQ(floor.summary.minimum.upper, 0);
    EXPECT_EQ(floor.summary.uniformity.value, 0);
    EXPECT_TRUE(std::isfinite(floor.summary.uniformity.lower) &&
                std::isfinite(floor.summary.uniformity.upper));
    EXPECT_GT(floor.summary.maximum.value, 0);
}

/// In a furnace all patches have the same light: nothing is lost by them.
TEST(PatchErrorOfNothing, IsSmall) {
    Scene scene;
    add_area_light(scene, inward({{0, 0, 0}, {4, 3, 2.8}}), Rgb::grey(50), diffuse(0.6));
    const Sensor grid{"floor", Grid{{0.5, 0.5, 0}, {3, 0, 0}, {0, 2, 0}, {8, 8}, kUp}};
    const RunResult result = measure(scene, {&grid, 1}, coarse_options("ray-bundle", 0.5));
    EXPECT_LT(*result.sensors[0].patch_error, 0.01);
}

/// Of the pixels' luminances.
double relative_rms_difference(const RenderResult& picture, const RenderResult& exact) {
    double squares = 0;
    for (std::size_t i = 0; i < exact.depth_m.size(); ++i) {
        const double value = picture.pixels.rgb_cd_m2[i][1];
        squares += std::pow((value - double{exact.pixels.rgb_cd_m2[i][1]}) / value, 2);
    }
    return std::sqrt(squares / static_cast<double>(exact.depth_m.size()));
}

/// A picture by patches of 1 m of a lamp's light on a wall near it, and the same by path tracing.
TEST(PatchErrorOfPictures, IsInTheStatedError) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.5));
    add_object(scene, Box{{1.5, 1, 0}, {2.5, 2, 1}}, diffuse(0.5));
    add_point_light(scene, {3, 2.5, 1.5}, Rgb::grey(100));
    const Sensor view{"view",
                      Camera{{0.2, 0.2, 1.6}, {3, 2, 0.8}, kUp, 80, {40, 30}, Projection::perspective}};
    RunOptions options;
    options.method = "path";
    options.paths = 4096;
    const RenderResult exact = render(scene, view, options);
    EXPECT_FALSE(exact.patch_error);

    options.method = "ray-bundle";
    options.patch_m = 1;
    options.paths = 64;
    const auto expect_stated = [&](const RenderResult& result) {
        const double found = relative_rms_difference(result, exact);
        ASSERT_TRUE(result.patch_error);
        EXPECT_GT(found, 0.05);  // or nothing is tested
        EXPECT_GT(*result.patch_error, 0.7 * found);
        EXPECT_LT(*result.patch_error, 1.5 * found);
        EXPECT_GT(result.attained_error, 2 * 0.7 * found);
        ASSERT_FALSE(result.warnings.empty());
        EXPECT_NE(result.warnings[0].text.find("smaller patches"), std::string::npos)
            << result.warnings[0].text;
    };
    const RenderResult by_patches = render(scene, view, options);
    expect_stated(by_patches);

    // A solution gathers light at the vertices of finer patches.
    options.paths = 512;
    const RenderResult solved = render_solution(scene, view, solve(scene, options).solution);
    double noise = 0;
    for (std::size_t i = 0; i < exact.depth_m.size(); ++i) {
        noise += std::pow(solved.pixels.standard_error_cd_m2[i] / solved.pixels.rgb_cd_m2[i][1], 2) /
                 static_cast<double>(exact.depth_m.size());
    }
    ASSERT_TRUE(solved.patch_error);
    EXPECT_LT(*solved.patch_error, 0.5 * *by_patches.patch_error);
    EXPECT_GT(std::hypot(*solved.patch_error, std::sqrt(noise)),
              0.9 * relative_rms_difference(solved, exact));
}

}  // namespace
}  // namespace stilb::run
