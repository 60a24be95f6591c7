#include <gtest/gtest.h>

#include <cmath>

#include "estimators/estimator_list.h"
#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/thin_dielectric.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "stilb/error.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

Scene plain_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, Diffuse{{{0.7, 0.6, 0.4}}});
    add_object(scene, Box{{2, 1, 0}, {2.6, 1.6, 1}}, Phong{Rgb::grey(0.3), Rgb::grey(0.3), 20});
    add_area_light(scene, Rectangle{{1, 0.6, 2.7}, {0, 1.6, 0}, {2, 0, 0}}, Rgb::grey(100));
    return scene;
}

/// With a mirror, a pane and a ball of glass.
Scene furnished_room() {
    Scene scene = plain_room();
    add_object(scene, Rectangle{{0.4, 2.95, 0.5}, {1.2, 0, 0}, {0, 0, 1.2}}, Mirror{Rgb::grey(0.9)});
    add_object(scene, Rectangle{{3, 0.2, 0}, {0, 1, 0}, {0, 0, 1.5}}, ThinDielectric{1.52, Rgb::grey(0.96)});
    add_object(scene, Sphere{{1.2, 1.8, 0.4}, 0.35}, Dielectric{1.5});
    return scene;
}

Sensor camera(Projection projection, int width, int height) {
    const double fov_deg = projection == Projection::perspective ? 85 : 180;
    return {"camera",
            Camera{{0.3, 0.3, 1.5}, {2.5, 2, 0.8}, {0, 0, 1}, fov_deg, {width, height}, projection}};
}

RenderResult render_with(const Scene& scene, const Sensor& sensor, const std::string& method,
                         std::uint64_t seed, std::uint64_t passes) {
    RunOptions options;
    options.method = method;
    options.seed = seed;
    options.paths = passes;
    return render(scene, sensor, options);
}

/// The picture's mean luminance, from independent renderings.
statistics::Estimate mean_luminance(const Scene& scene, const Sensor& sensor, const std::string& method,
                                    std::uint64_t passes = 16) {
    std::vector<double> means;
    // `double-local` has an infinite variance in corners: with seed 9, one vertex is so close to a sub-point
    // that its picture is twice as bright.
    for (std::uint64_t seed = 10; seed < 42; ++seed) {
        means.push_back(render_with(scene, sensor, method, seed, passes).mean_luminance_cd_m2);
    }
    return statistics::estimate_from_replicates(means);
}

TEST(Render, MethodsAgree) {
    const Scene scene = furnished_room();
    const Sensor sensor = camera(Projection::perspective, 33, 21);  // blocks of all sizes
    const double factor = coarser(2);
    const std::uint64_t passes = std::max(fewer(16, 2), std::uint64_t{2});
    std::vector<statistics::Estimate> estimates;
    for (const estimators::EstimatorEntry& method : estimators::unbiased_estimators()) {
        if (!method.measures_luminance) continue;
        estimates.push_back(mean_luminance(scene, sensor, std::string(method.name), passes));
        EXPECT_LT(estimates.back().standard_error, 0.003 * factor * estimates.back().value) << method.name;
    }
    ASSERT_EQ(estimates.size(), 3u);
    const double threshold = statistics::sidak_threshold_z(0.001, 3);
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_LT(std::abs(statistics::equivalent_z(z_score(estimates[i], estimates[j]), 31)), threshold)
                << estimates[i].value << ' ' << estimates[j].value;
        }
    }
}

/// The picture is planned from few sub-points, and none of them lies on the plate, which is all that there is
/// to see: light of a lit floor behind the camera.
TEST(Render, ShowsWhatPlanningDidNotSee) {
    Scene scene;
    add_object(scene, Rectangle{{-4, -2, -1.5}, {4, 0, 0}, {0, 4, 0}}, diffuse(0.6));
    add_object(scene, Rectangle{{1, -0.05, -0.05}, {0, 0.1, 0}, {0, 0, 0.1}}, diffuse(0.6));
    add_area_light(scene, Rectangle{{-3, -1, -0.2}, {0, 2, 0}, {2, 0, 0}}, Rgb::grey(100));
    const Sensor sensor{"camera",
                        Camera{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 90, {16, 16}, Projection::perspective}};
    const statistics::Estimate guided = mean_luminance(scene, sensor, "auto", fewer(256, 1.5));
    const statistics::Estimate traced = mean_luminance(scene, sensor, "path", fewer(256, 1.5));
    EXPECT_LT(guided.standard_error, 0.03 * coarser(1.5) * guided.value);
    EXPECT_LT(std::abs(statistics::equivalent_z(z_score(guided, traced), 31)),
              statistics::sidak_threshold_z(0.001, 1))
        << guided.value << ' ' << traced.value;
}

/// The relative variance of a pixel in some rows, on average, over independent renderings.
double pixel_variance(const Scene& scene, const Camera& camera, const std::string& technique, int first_row,
                      int last_row) {
    constexpr std::uint64_t seeds = 12;
    const auto width = static_cast<std::size_t>(camera.resolution[0]);
    const std::size_t first = static_cast<std::size_t>(first_row) * width,
                      count = static_cast<std::size_t>(last_row - first_row) * width;
    std::vector<double> sums(count), squares(count);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const RenderResult result = render_with(scene, {"camera", camera}, technique, seed, 8);
        for (std::size_t i = 0; i < count; ++i) {
            const double value = double{result.pixels.rgb_cd_m2[first + i][1]};
            sums[i] += value;
            squares[i] += value * value;
        }
    }
    double all = 0;
    for (std::size_t i = 0; i < count; ++i) all += seeds * squares[i] / (sums[i] * sums[i]) - 1;
    return all / static_cast<double>(count);
}

/// Cells of 16 x 16 pixels are planned from some of their sub-points. Here all of these lie on the floor, but
/// the rows above show the wall, too, whose light must not be chosen as if it were floor: floors do not light
/// themselves.
TEST(Render, IsAsSureWherePlanningSawOneOfTwoSurfaces) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {18, 10, 6}}, diffuse(0.6));
    add_area_light(scene, Rectangle{{4, 4, 5.9}, {0, 2, 0}, {2, 0, 0}}, Rgb::grey(2400));
    const auto variance = [&](const std::string& technique, double target_z, int first_row) {
        const Camera camera{{9, 5, 1.7}, {9, 9.9, target_z}, {0, 0, 1},
                            60,          {64, 64},           Projection::perspective};
        return pixel_variance(scene, camera, technique, first_row, first_row + 3);
    };
    for (const char* technique : {"light-paths", "guided"}) {
        // The same rows one pixel lower, where planning sees the wall, too.
        const double unseen = variance(technique, 0.22, 32), seen = variance(technique, 0.3, 33);
        EXPECT_LT(unseen, 2 * seen) << technique;
    }
}

TEST(Render, ErrorsOfPixelsAreHonest) {
    // No glass: the bright spots under it are found so seldom that few passes do not know their errors.
    const Scene scene = plain_room();
    const Sensor sensor = camera(Projection::perspective, 24, 16);
    const RenderResult exact = render_with(scene, sensor, "auto", 1, 1024);
    for (const estimators::EstimatorEntry& method : estimators::unbiased_estimators()) {
        // Where the variance is infinite, in corners, there is no honest error.
        if (!method.measures_luminance || method.has_heavy_tails) continue;
        const RenderResult picture = render_with(scene, sensor, std::string(method.name), 2, 32);
        double inside = 0;
        for (std::size_t i = 0; i < exact.depth_m.size(); ++i) {
            const auto luminance = [&](const Pixels& pixels) {
                const auto& [r, g, b] = pixels.rgb_cd_m2[i];
                return Rgb{{r, g, b}}.luminance();
            };
            const double error =
                std::hypot(picture.pixels.standard_error_cd_m2[i], exact.pixels.standard_error_cd_m2[i]);
            const double t = statistics::student_t_quantile(0.975, 15);
            inside += std::abs(luminance(picture.pixels) - luminance(exact.pixels)) <= t * error;
        }
        const double share = inside / static_cast<double>(exact.depth_m.size());
        EXPECT_GT(share, 0.91) << method.name;
        EXPECT_LT(share, 0.99) << method.name;
    }
}

TEST(Render, DoesNotDependOnThreads) {
    const Scene scene = furnished_room();
    const Sensor sensor = camera(Projection::panorama, 40, 20);
    for (const std::string method : {"auto", "double-local", "path"}) {
        RunOptions options;
        options.method = method;
        options.paths = 18;
        options.threads = 1;
        const RenderResult one = render(scene, sensor, options);
        options.threads = 3;
        const RenderResult three = render(scene, sensor, options);
        EXPECT_EQ(one.pixels.rgb_cd_m2, three.pixels.rgb_cd_m2) << method;
        EXPECT_EQ(one.pixels.standard_error_cd_m2, three.pixels.standard_error_cd_m2) << method;
        EXPECT_EQ(one.samples, 18u);
    }
}

/// With cells that take part in fewer passes than others.
TEST(Render, ByErrorDoesNotDependOnThreads) {
    const Scene scene = furnished_room();
    RunOptions options;
    options.error = 0.0001;
    options.paths = 42;
    const Sensor sensor = camera(Projection::panorama, 64, 32);
    options.threads = 1;
    const RenderResult one = render(scene, sensor, options);
    options.threads = 3;
    const RenderResult three = render(scene, sensor, options);
    EXPECT_EQ(one.pixels.rgb_cd_m2, three.pixels.rgb_cd_m2);
    EXPECT_EQ(one.pixels.standard_error_cd_m2, three.pixels.standard_error_cd_m2);
    EXPECT_EQ(one.samples, 42u);
    EXPECT_EQ(one.samples_per_pixel, three.samples_per_pixel);
    EXPECT_LT(one.samples_per_pixel, 40);
}

TEST(Render, ByErrorTakesSmallPicturesAndFisheyes) {
    const Scene scene = plain_room();
    RunOptions options;
    options.error = 0.1;
    for (const Sensor& sensor :
         {camera(Projection::perspective, 3, 2), camera(Projection::fisheye, 41, 41)}) {
        const RenderResult picture = render(scene, sensor, options);
        EXPECT_TRUE(picture.converged);
        EXPECT_LE(picture.attained_error, 0.1);
        EXPECT_GT(picture.mean_luminance_cd_m2, 0);
        const bool sees_corner = sensor.camera()->projection == Projection::perspective;
        EXPECT_EQ(std::isnan(picture.pixels.standard_error_cd_m2[0]), !sees_corner);
    }
}

TEST(Render, SeesALampAsItIsAndNothingBesideAFisheye) {
    Scene scene;
    add_area_light(scene, Sphere{{2.5, 2, 0.8}, 0.5}, Rgb::grey(250), Black{});
    const Sensor sensor = camera(Projection::fisheye, 21, 21);
    const RenderResult picture = render_with(scene, sensor, "auto", 1, 2);
    const std::size_t middle = 21 * 10 + 10;
    EXPECT_EQ(picture.pixels.rgb_cd_m2[middle][1], 250);
    EXPECT_EQ(picture.pixels.standard_error_cd_m2[middle], 0);
    EXPECT_NEAR(picture.depth_m[middle], length(Vec3{2.2, 1.7, -0.7}) - 0.5, 1e-3);
    EXPECT_TRUE(std::isnan(picture.pixels.rgb_cd_m2[0][0]));
    EXPECT_TRUE(std::isnan(picture.depth_m[0]));
    EXPECT_EQ(picture.pixels.rgb_cd_m2[21 * 10 + 1][1], 0) << "dark, but seen";
}

TEST(Render, RefusesWhatCannotBe) {
    const Scene scene = furnished_room();
    EXPECT_THROW(render_with(scene, camera(Projection::perspective, 4, 4), "local", 1, 2), InputError);
    EXPECT_THROW(render_with(scene, camera(Projection::perspective, 4, 4), "pth", 1, 2), InputError);
}

}  // namespace
}  // namespace stilb::run
