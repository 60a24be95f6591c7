// Radiosity and particles against exact values and path tracing, and what only these two have.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// A cube of 4 m with 10 klm at its centre.
Scene lamp_in_cube(double reflectance) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 4}}, diffuse(reflectance));
    add_point_light(scene, {2, 2, 2}, Rgb::grey(10'000 / (4 * std::numbers::pi)));
    return scene;
}

/// On the cube's floor.
double direct_lx(const Vec3& place) {
    const double squared = squared_length(place - Vec3{2, 2, 2});
    return 10'000 / (4 * std::numbers::pi) * 2 / std::pow(squared, 1.5);
}

/// Coloured, with a large light, a small one and a point, a cabinet, a table and a black ball.
Scene furnished_baseline_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, Diffuse{{{0.7, 0.6, 0.4}}});
    add_object(scene, Box{{0.4, 2.1, 0}, {1.4, 2.8, 1.2}}, Diffuse{{{0.2, 0.4, 0.7}}});
    add_object(scene, Rectangle{{2, 0.8, 0.7}, {1.2, 0, 0}, {0, 0.8, 0}}, diffuse(0.5));
    add_object(scene, Sphere{{3.3, 2.4, 0.4}, 0.4}, Black{});
    add_area_light(scene, Rectangle{{0.6, 0.6, 2.7}, {0, 1.6, 0}, {1.6, 0, 0}}, Rgb::grey(300));
    add_area_light(scene, Sphere{{3.4, 0.5, 2.2}, 0.06}, Rgb::grey(10'000));
    add_point_light(scene, {3.2, 2, 2}, {{60, 40, 20}});
    return scene;
}

RunOptions baseline_options(const std::string& method, double patch_m, std::uint64_t particles = 1 << 20) {
    RunOptions options;
    options.method = method;
    options.patch_m = patch_m;
    options.patches.shot_resolution = 32;
    options.paths = method == "particles" ? particles : 1 << 12;
    return options;
}

double value_of(const RunResult& result, std::size_t reading) {
    return result.sensors[0].readings[reading].estimate.value;
}

class PatchBaseline : public testing::TestWithParam<const char*> {};

TEST_P(PatchBaseline, LightsACubeAsComputed) {
    const Vec3 middle{2, 2, 0}, corner{0.5, 0.5, 0};
    const std::vector<Sensor> sensors{point_sensor({{middle, kUp}, {corner, kUp}}),
                                      Sensor{"floor", Grid{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {8, 8}, kUp}}};
    const RunResult result = measure(lamp_in_cube(0.8), sensors, baseline_options(GetParam(), 0.5));
    EXPECT_NEAR(value_of(result, 0) - direct_lx(middle), 430.95, 0.01 * 430.95);
    EXPECT_NEAR(value_of(result, 1) - direct_lx(corner), 403.10, 0.01 * 403.10);
    double direct = 0;
    for (const Measurand& cell : sensors[1].measurands()) direct += direct_lx(position_of(cell)) / 64;
    EXPECT_NEAR(result.sensors[1].summary.mean.value - direct, 416.67, 0.01 * 416.67);
}

/// All walls shine and reflect: L = Le / (1 - rho) everywhere.
TEST_P(PatchBaseline, FillsAFurnace) {
    constexpr double kReflectance = 0.7;
    Scene scene;
    for (std::size_t i = 0; i < 6; ++i) {
        add_area_light(scene, wall({{0, 0, 0}, {4, 3, 2}}, i / 2, i % 2 == 0 ? Side::low : Side::high),
                       Rgb::grey(10), diffuse(kReflectance));
    }
    Luminance lines;
    for (const Vec3& way : {Vec3{0.2, 0.3, -1}, Vec3{1, 0.2, 0.3}, Vec3{-1, -1, 1}}) {
        lines.sights.emplace_back(LineOfSight{{2, 1.5, 1}, normalized(way)});
    }
    const Sensor sights{"sights", lines};
    const RunResult result = measure(scene, {&sights, 1}, baseline_options(GetParam(), 0.4));
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(value_of(result, j), 10 / (1 - kReflectance), 0.3) << j;
}

TEST_P(PatchBaseline, ApproachesPathTracingAsPatchesShrink) {
    const Scene scene = furnished_baseline_room();
    Luminance lines;
    for (int i = 0; i < 64; ++i) {  // all around, by the golden section
        const double z = (i + 0.5) / 32 - 1, turn = 2 * std::numbers::pi * i / std::numbers::phi;
        const double r = std::sqrt(1 - z * z);
        lines.sights.emplace_back(LineOfSight{{2.1, 1.7, 1.3}, {r * std::cos(turn), r * std::sin(turn), z}});
    }
    const std::vector<Sensor> sensors{
        Sensor{"desk", Grid{{0.1, 0.1, 0.75}, {3.8, 0, 0}, {0, 1.9, 0}, {8, 4}, kUp}}, {"sights", lines}};
    RunOptions path;
    path.method = "path";
    path.paths = 1 << 13;
    const RunResult exact = measure(scene, sensors, path);
    double largest = 1;
    for (const double patch_m : {1., 0.3}) {
        const RunResult result = measure(scene, sensors, baseline_options(GetParam(), patch_m));
        double error = 0;
        for (std::size_t s = 0; s < 2; ++s) {
            const double expected = exact.sensors[s].summary.mean.value;
            const double now = std::abs(result.sensors[s].summary.mean.value / expected - 1);
            error = std::max(error, now);
        }
        EXPECT_LT(error, largest) << patch_m;
        largest = error;
    }
    EXPECT_LT(largest, 0.01);
}

TEST_P(PatchBaseline, PicturesShowWhatMetersMeasure) {
    const Scene scene = furnished_baseline_room();
    const Sensor camera{"camera",
                        Camera{{0.3, 0.3, 1.5}, {2.3, 1.3, 0.7}, kUp, 70, {24, 16}, Projection::perspective}};
    RunOptions options = baseline_options(GetParam(), 0.3);
    options.paths = 64;
    const RenderResult baseline = render(scene, camera, options);
    options.method = "path";
    options.paths = 512;
    const RenderResult path = render(scene, camera, options);
    EXPECT_NEAR(baseline.mean_luminance_cd_m2, path.mean_luminance_cd_m2, 0.01 * path.mean_luminance_cd_m2);
}

TEST_P(PatchBaseline, ReportsWhatBecameOfLights) {
    const Sensor floor = point_sensor({{{1, 1.3, 0}, kUp}});
    const RunResult result =
        measure(furnished_baseline_room(), {&floor, 1}, baseline_options(GetParam(), 1, 1 << 17));
    ASSERT_TRUE(result.patches);
    EXPECT_GT(result.patches->count, 100U);
    EXPECT_EQ(result.patches->size_m, 1);
    const bool has_first_shot = std::string("radiosity") == GetParam();
    ASSERT_EQ(result.patches->lights.size(), 3U);
    for (const estimators::FirstShotLight& light : result.patches->lights) {
        EXPECT_EQ(light.is_replaced, has_first_shot) << light.why;
    }
    EXPECT_EQ(result.patches->bytes_per_patch > 0, has_first_shot);
}

TEST_P(PatchBaseline, ThreadsChangeNothing) {
    const Scene scene = furnished_baseline_room();
    const Sensor floor = point_sensor({{{1, 1.3, 0}, kUp}, {{3, 1.3, 0.8}, kUp}});
    RunOptions options = baseline_options(GetParam(), 1.5, 1 << 17);
    const RunResult once = measure(scene, {&floor, 1}, options);
    for (const int threads : {1, 3}) {
        options.threads = threads;
        const RunResult again = measure(scene, {&floor, 1}, options);
        for (std::size_t j = 0; j < 2; ++j) EXPECT_EQ(value_of(again, j), value_of(once, j)) << threads;
    }
}

TEST_P(PatchBaseline, RefusesWhatIsNotDiffuse) {
    const Sensor floor = point_sensor({{{1, 1.3, 0}, kUp}});
    for (const Material& material :
         {Material{Phong{Rgb::grey(0.3), Rgb::grey(0.4), 5}}, Material{Mirror{Rgb::grey(0.9)}}}) {
        Scene scene = lamp_in_cube(0.5);
        add_object(scene, Sphere{{1, 1, 1}, 0.3}, material);
        scene.objects.back().name = "vase";
        scene.materials.back().name = "glaze";
        try {
            measure(scene, {&floor, 1}, baseline_options(GetParam(), 1));
            FAIL();
        } catch (const InputError& error) {
            const std::string text = error.what();
            for (const char* part : {"vase", "glaze", GetParam(), "ray-bundle"}) {
                EXPECT_NE(text.find(part), std::string::npos) << text;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, PatchBaseline, testing::Values("radiosity", "particles"),
                         [](const auto& method) { return std::string(method.param); });

TEST(Radiosity, SamplesTheWayFromPatchesToPoints) {
    const std::vector<Sensor> sensors{Sensor{"floor", Grid{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 1}, kUp}}};
    RunOptions options = baseline_options("radiosity", 1);
    options.paths.reset();
    options.error = 0.01;
    const RunResult result = measure(lamp_in_cube(0.5), sensors, options);
    EXPECT_EQ(result.stop_reason, StopReason::target_reached);
    for (const Reading& reading : result.sensors[0].readings) {
        EXPECT_GT(reading.estimate.standard_error, 0);
        EXPECT_LT(relative_half_width(reading.estimate), 0.01);
    }
}

/// Light of a point that no first shot brings to the patches would be missing without a word.
TEST(Radiosity, RefusesToLoseLight) {
    const Sensor floor = point_sensor({{{1, 1.3, 0}, kUp}});
    for (const estimators::FirstShotVariant variant :
         {estimators::FirstShotVariant::none, estimators::FirstShotVariant::on_the_fly}) {
        RunOptions options = baseline_options("radiosity", 1);
        options.patches.first_shot.variant = variant;
        EXPECT_THROW(measure(lamp_in_cube(0.5), {&floor, 1}, options), InputError) << name_of(variant);
    }
}

/// The rear half of a cube carries nothing.
TEST(Radiosity, CubesSeeWhatHemicubesSee) {
    const Sensor floor = point_sensor({{{1, 1.3, 0}, kUp}});
    RunOptions options = baseline_options("radiosity", 1);
    const double expected = value_of(measure(furnished_baseline_room(), {&floor, 1}, options), 0);
    options.patches.first_shot.shooting.window = patches::BufferShape::cube;
    EXPECT_NEAR(value_of(measure(furnished_baseline_room(), {&floor, 1}, options), 0), expected,
                1e-3 * expected);
}

}  // namespace
}  // namespace stilb::run
