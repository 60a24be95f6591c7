// Light from infinity by every method: exact values where patches make no error, and pictures of it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run/run.h"
#include "run/solve.h"
#include "statistics/hypothesis.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kFurnaceReflectance = 0.6, kEmitted = 10, kEverywhere = kEmitted / (1 - kFurnaceReflectance);

/// A room whose walls shine and reflect; one is open to an environment as bright as what it would be: the
/// luminance is the same everywhere, so that patches are exact.
Scene open_furnace() {
    Scene scene;
    const Box room{{0, 0, 0}, {4, 3, 2.8}};
    for (const std::size_t axis : {0, 1, 2}) {
        add_area_light(scene, wall(room, axis, Side::low), Rgb::grey(kEmitted), diffuse(kFurnaceReflectance));
        if (axis != 1)
            add_area_light(scene, wall(room, axis, Side::high), Rgb::grey(kEmitted),
                           diffuse(kFurnaceReflectance));
    }
    add_environment(scene, Rgb::grey(kEverywhere));
    return scene;
}

/// A box alone under a sky, of which each face has one illuminance: patches are exact here too.
Scene box_under_sky() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {1, 0.8, 0.6}}, diffuse(kFurnaceReflectance));
    add_sky(scene);
    return scene;
}

RunOptions options_of(const std::string& method, std::uint64_t paths) {
    RunOptions options;
    options.method = method;
    options.paths = paths;
    options.patch_m = 0.7;
    options.patches.first_shot.variant = estimators::FirstShotVariant::none;
    return options;
}

void expect_all(const Scene& scene, const std::vector<Sensor>& sensors, const std::vector<double>& exact,
                const RunOptions& options, double largest_error) {
    const RunResult result = measure(scene, sensors, options);
    std::size_t i = 0;
    for (const SensorResult& sensor : result.sensors) {
        for (const Reading& reading : sensor.readings) {
            const statistics::Estimate& e = reading.estimate;
            const double rounding = 1e-6 * exact[i];  // of single precision in patches
            const double z = (e.value - exact[i]) / std::hypot(e.standard_error, rounding);
            EXPECT_LT(std::abs(statistics::equivalent_z(z, result.replicates - 1)), 4)
                << options.method << ", reading " << i << ": " << e.value << " +- " << e.standard_error
                << ", exact " << exact[i];
            EXPECT_LT(e.standard_error, largest_error * exact[i]) << options.method << ", reading " << i;
            ++i;
        }
    }
    EXPECT_EQ(i, exact.size());
}

TEST(Environment, LeavesAnOpenFurnaceAsItIs) {
    const Sensor points =
        point_sensor({{{2, 1, 0}, kUp}, {{2, 2.5, 1.5}, {0, 1, 0}}, {{1, 1, 1}, {1, 0, 0}}});
    const Sensor sights{"sights", Luminance{{LineOfSight{{2, 1.5, 1.2}, normalized(Vec3{1, 0.4, -1})},
                                             LineOfSight{{2, 1.5, 1.2}, normalized(Vec3{0.1, 1, 0.1})}}}};
    const double illuminance = std::numbers::pi * kEverywhere;
    const std::vector<double> exact{illuminance, illuminance, illuminance, kEverywhere, kEverywhere};
    for (const auto& [method, paths] : {std::pair{"ray-bundle", 1u << 13}, {"particles", 1u << 19}})
        expect_all(open_furnace(), {points, sights}, exact, options_of(method, paths), 0.01);
}

TEST(Environment, LightsTheFacesOfABox) {
    const Scene scene = box_under_sky();
    const auto& light = std::get<EnvironmentLight>(scene.lights[0].source);
    // What a finer picture with the same pixels gives by midpoints.
    const auto exact_lx = [&](const Vec3& normal) {
        constexpr int kFiner = 32;
        Panorama::Image image{16 * kFiner, 8 * kFiner, {}};
        for (int row = 0; row < 8 * kFiner; ++row) {
            for (int column = 0; column < 16 * kFiner; ++column) {
                const double theta = std::numbers::pi * (row + 0.5) / (8 * kFiner);
                const double azimuth = std::numbers::pi * (1 - 2 * (column + 0.5) / (16 * kFiner));
                const Rgb rgb =
                    light.panorama->luminance_cd_m2({std::sin(theta) * std::cos(azimuth),
                                                     std::sin(theta) * std::sin(azimuth), std::cos(theta)});
                image.rgb_cd_m2.push_back(
                    {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])});
            }
        }
        return Panorama(image).illuminance_lx(normal).luminance();
    };
    Luminance reflected;
    std::vector<double> exact;
    for (const auto& [place, normal] : {std::pair{Vec3{0.5, 0.4, 0.6}, kUp},
                                        {Vec3{1, 0.4, 0.3}, Vec3{1, 0, 0}},
                                        {Vec3{0.5, 0, 0.3}, Vec3{0, -1, 0}}}) {
        reflected.sights.emplace_back(EmergentRay{place, normal, normal});
        exact.push_back(kFurnaceReflectance / std::numbers::pi * exact_lx(normal));
    }
    const Sensor sights{"sights", reflected};
    // 16 x 8 pixels on 512 x 256 are within 1e-4 of the integral.
    const RunResult result = measure(scene, {&sights, 1}, options_of("ray-bundle", 1 << 16));
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const statistics::Estimate& e = result.sensors[0].readings[i].estimate;
        EXPECT_LT(std::abs(e.value - exact[i]), 4.5 * e.standard_error + 2e-4 * exact[i]) << i;
        EXPECT_LT(e.standard_error, 0.03 * exact[i]) << i;
    }
    expect_all(scene, {sights}, exact, options_of("auto", 1 << 19), 0.004);
    expect_all(scene, {sights}, exact, options_of("path", 1 << 19), 0.004);
}

TEST(Environment, IsRefusedByRadiosity) {
    const Sensor points = point_sensor({{{0.5, 0.4, 0.6}, kUp}});
    EXPECT_THROW(measure(box_under_sky(), {&points, 1}, options_of("radiosity", 1)), InputError);
}

Sensor panorama_camera(const Vec3& towards) {
    return {"camera", Camera{{0, 0, 0}, towards, {0, 0, 1}, 360, {32, 16}, Projection::panorama}};
}

/// A picture of a scene, taken for the environment of nothing, makes the same picture.
TEST(Environment, APanoramaOfItselfIsItself) {
    Scene scene;
    add_area_light(scene, Sphere{{3, 1, 0.5}, 1}, Rgb{{100, 40, 10}});
    add_area_light(scene, Sphere{{-2, -2, 2}, 0.5}, Rgb{{10, 400, 100}});
    add_environment(scene, Rgb{{3, 2, 5}});
    RunOptions options;
    options.method = "path";
    options.paths = 8;
    for (const double rotation_deg : {0.0, 70.0}) {
        const double rotation = rotation_deg * std::numbers::pi / 180;
        const Sensor camera = panorama_camera({std::cos(rotation), std::sin(rotation), 0});
        const auto picture = render(scene, camera, options).pixels.rgb_cd_m2;
        Scene surrounded;
        EnvironmentLight light;
        light.panorama = std::make_shared<const Panorama>(Panorama::Image{32, 16, picture});
        light.axes = lights::panorama_axes(kUp, rotation_deg);
        surrounded.lights.push_back({"sky", light});
        for (const std::string method : {"path", "auto"}) {
            options.method = method;
            const auto again = render(surrounded, camera, options).pixels.rgb_cd_m2;
            ASSERT_EQ(again.size(), picture.size());
            for (std::size_t i = 0; i < picture.size(); ++i) {
                for (std::size_t b = 0; b < kBands; ++b)
                    ASSERT_NEAR(again[i][b], picture[i][b], 1e-5 * picture[i][b])
                        << method << ", pixel " << i;
            }
        }
        options.method = "path";
    }
}

/// What is seen beside surfaces is what surrounds them, whatever the method.
TEST(Environment, IsTheBackgroundOfPictures) {
    Scene scene = box_under_sky();
    const Sensor camera{"camera",
                        Camera{{4, 4, 2}, {0.5, 0.4, 0.3}, {0, 0, 1}, 50, {9, 9}, Projection::perspective}};
    for (const std::string method : {"path", "auto", "double-local", "ray-bundle", "particles"}) {
        const auto pixels = render(scene, camera, options_of(method, 4)).pixels.rgb_cd_m2;
        // The upper left pixel looks 4 degrees upwards, the lower left one 40 downwards: to one pixel of the
        // sky each.
        EXPECT_NEAR(pixels[0][1], 55, 1e-5) << method;
        EXPECT_NEAR(pixels[72][1], 20, 1e-5) << method;
    }
    const auto solved = solve(scene, options_of("ray-bundle", 256));
    EXPECT_NEAR(render_solution(scene, camera, solved.solution).pixels.rgb_cd_m2[0][1], 55, 1e-5);
}

}  // namespace
}  // namespace stilb::run
