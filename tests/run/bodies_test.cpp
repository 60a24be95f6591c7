// Cylindrical, semicylindrical, hemispherical and spherical illuminance by all methods against exact values.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "estimators/estimator_list.h"
#include "exact/closed_rooms.h"
#include "exact/configuration_factors.h"
#include "materials/black.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

const Vec3 kFacing = normalized(Vec3{1, -2, 0});
const Vec3 kTilted = normalized(Vec3{1, -2, 3});

/// One of each kind at a place: cylinder, semicylinder, hemisphere, sphere.
std::vector<Sensor> bodies_at(const Vec3& position) {
    const std::vector<Vec3> at{position};
    return {{"cylinder", Cylindrical{at}},
            {"semicylinder", Semicylindrical{at, kFacing}},
            {"hemisphere", Hemispherical{at, kTilted}},
            {"sphere", Spherical{at}}};
}

std::vector<std::string> all_methods() {
    std::vector<std::string> methods;
    for (const estimators::EstimatorEntry& method : estimators::estimator_list()) {
        if (method.name != "double-local") methods.emplace_back(method.name);
    }
    return methods;
}

RunOptions body_options(const std::string& method, std::uint64_t paths, std::uint64_t seed = 1) {
    RunOptions options;
    options.method = method;
    options.paths = method == "ray-bundle" ? paths / 16 : paths;  // a step does more than a path
    options.seed = seed;
    options.patch_m = 0.5;
    return options;
}

statistics::Estimate estimate(const RunResult& result, std::size_t sensor) {
    return result.sensors[sensor].readings[0].estimate;
}

/// Compares the readings of the four bodies by z-scores. The form factors of radiosity, which come from item
/// buffers, have errors of about a tenth of a per cent.
void expect_exact(const RunResult& result, const std::array<double, 4>& exact_lx, double rounding) {
    if (result.method == "radiosity") rounding = 1e-3;
    for (std::size_t b = 0; b < 4; ++b) {
        const statistics::Estimate e = estimate(result, b);
        const double error = std::hypot(e.standard_error, rounding * exact_lx[b]);
        EXPECT_LT(error, 0.01 * exact_lx[b]) << result.method << ", body " << b;
        const double z = (e.value - exact_lx[b]) / error;
        EXPECT_LT(std::abs(statistics::equivalent_z(z, result.replicates - 1)), 4.2)
            << result.method << ", body " << b << ": " << e.value << " for " << exact_lx[b];
    }
}

class BodiesBy : public testing::TestWithParam<std::string> {};

TEST_P(BodiesBy, APointSource) {
    constexpr double intensity_cd = 100;
    const Vec3 source{2.5, 1.5, 2.4}, at{1, 1, 1};
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, Black{});
    add_point_light(scene, source, Rgb::grey(intensity_cd));
    const RunResult result = measure(scene, bodies_at(at), body_options(GetParam(), 64));

    const Vec3 way = normalized(source - at);
    const double normal_lx = intensity_cd / squared_length(source - at);
    const double sine = std::hypot(way.x, way.y), cos_azimuth = dot(way, kFacing) / sine;
    const std::array<double, 4> exact_lx{normal_lx * sine / kPi, normal_lx * sine * (1 + cos_azimuth) / kPi,
                                         normal_lx * (1 + dot(way, kTilted)) / 4, normal_lx / 4};
    for (std::size_t b = 0; b < 4; ++b) {
        EXPECT_NEAR(estimate(result, b).value, exact_lx[b], 1e-12 * exact_lx[b]) << b;
    }
}

TEST_P(BodiesBy, AFurnace) {
    constexpr double reflectance = 0.6, luminance = 50;
    Scene scene;
    add_area_light(scene, inward({{0, 0, 0}, {4, 3, 2.8}}), Rgb::grey(luminance), diffuse(reflectance));
    const double exact_lx = exact::furnace_illuminance_lx(luminance, reflectance);
    const RunResult result = measure(scene, bodies_at({1.3, 0.7, 1.1}), body_options(GetParam(), 1 << 15));
    expect_exact(result, {exact_lx, exact_lx, exact_lx, exact_lx}, 1e-6);
}

/// The upper half of what the bodies see is luminous, the lower half black.
TEST_P(BodiesBy, AUniformHalfSpace) {
    constexpr double luminance = 50;
    const Box upper{{0, 0, 1}, {4, 3, 2.8}};
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, Black{});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis < 2) add_area_light(scene, wall(upper, axis, Side::low), Rgb::grey(luminance));
        add_area_light(scene, wall(upper, axis, Side::high), Rgb::grey(luminance));
    }
    const RunResult result = measure(scene, bodies_at({1.3, 0.7, 1}), body_options(GetParam(), 1 << 15));
    const double half = kPi * luminance / 2;
    expect_exact(result, {half, half, half * (1 + kTilted.z / 2), half}, 1e-6);
}

/// The mean of what `lx` gives for normals on the curved sides, at positions by the midpoint rule.
std::array<double, 4> means_over_bodies(const auto& lx) {
    std::array<double, 4> means{};
    constexpr int azimuths = 2000;
    const double facing = std::atan2(kFacing.y, kFacing.x);
    for (int i = 0; i < azimuths; ++i) {
        const double turn = kPi * ((i + 0.5) / azimuths - 0.5);
        const auto level = [&](double angle) { return lx(Vec3{std::cos(angle), std::sin(angle), 0}); };
        means[1] += level(facing + turn) / azimuths;
        means[0] += (level(facing + turn) + level(facing + turn + kPi)) / (2 * azimuths);
    }
    constexpr int rings = 300;
    const Frame frame = Frame::around(kTilted);
    for (int i = 0; i < rings; ++i) {
        const double z = (i + 0.5) / rings, r = std::sqrt(1 - z * z);
        for (int j = 0; j < rings; ++j) {
            const double phi = 2 * kPi * (j + 0.5) / rings;
            const Vec3 normal = frame.to_world({r * std::cos(phi), r * std::sin(phi), z});
            means[2] += lx(normal) / (rings * rings);
            means[3] += (lx(normal) + lx(-normal)) / (2 * rings * rings);
        }
    }
    return means;
}

TEST_P(BodiesBy, ADiskLight) {
    constexpr double luminance = 1000;
    const exact::DiskPosition disk{{2, 1.5, 2.6}, {0.3, 0.1, -1}, 0.5};
    const Vec3 at{1, 1.2, 1.1};
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, Black{});
    add_area_light(scene, Disk{disk.center, normalized(disk.normal), disk.radius_m}, Rgb::grey(luminance));
    const auto lx = [&](const Vec3& normal) {
        return exact::illuminance_by_disk_lx({at, normal}, disk, luminance);
    };
    const RunResult result = measure(scene, bodies_at(at), body_options(GetParam(), 1 << 14));
    expect_exact(result, means_over_bodies(lx), 1e-5);
}

/// On the floor the lower half of the sphere is hidden, though the floor shines too: the upper half of a
/// furnace is left.
TEST_P(BodiesBy, AFurnaceOnItsFloor) {
    constexpr double reflectance = 0.6, luminance = 50;
    Scene scene;
    add_area_light(scene, inward({{0, 0, 0}, {4, 3, 2.8}}), Rgb::grey(luminance), diffuse(reflectance));
    const double half = exact::furnace_illuminance_lx(luminance, reflectance) / 2;
    const RunResult result = measure(scene, bodies_at({1.3, 0.7, 0}), body_options(GetParam(), 1 << 15));
    expect_exact(result, {half, half, half * (1 + kTilted.z / 2), half}, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Methods, BodiesBy, testing::ValuesIn(all_methods()), [](const auto& method) {
    std::string name = method.param;
    std::erase(name, '-');
    return name;
});

/// On the axis of a disk light everything is a formula of half its angle.
TEST(Bodies, OnTheAxisOfADiskLight) {
    constexpr double luminance = 1000, radius = 0.8, height = 1.3;
    const Vec3 at{1, 1, 1};
    Scene scene;
    add_area_light(scene, Disk{at + height * kUp, -kUp, radius}, Rgb::grey(luminance));
    const double angle = std::atan2(radius, height), c = std::cos(angle), s = std::sin(angle);
    const double round = luminance * (angle - s * c);
    const RunResult result = measure(scene, bodies_at(at), body_options("auto", 1 << 16));
    expect_exact(
        result,
        {round, round, kPi * luminance / 2 * (1 - c + kTilted.z * s * s / 2), kPi * luminance / 2 * (1 - c)},
        1e-9);
}

/// A room with reflections, a mirror and something in the way.
Scene furnished() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.6));
    add_object(scene, Rectangle{{0.02, 1, 1}, {0, 1, 0}, {0, 0, 0.7}}, Mirror{Rgb::grey(0.9)});
    add_object(scene, Box{{2, 1, 0}, {2.6, 1.8, 1.2}}, Phong{Rgb::grey(0.3), Rgb::grey(0.3), 20});
    add_area_light(scene, Rectangle{{0.8, 0.5, 2.6}, {0, 1, 0}, {1.4, 0, 0}}, Rgb::grey(500));
    return scene;
}

TEST(Bodies, CylindersReadTheMeanOfVerticalIlluminances) {
    const Vec3 at{1.2, 1.9, 1.3};
    IlluminancePoints all_around, in_front;
    constexpr int azimuths = 96;
    for (int i = 0; i < azimuths; ++i) {
        const double angle = 2 * kPi * i / azimuths;
        const Vec3 normal{std::cos(angle), std::sin(angle), 0};
        all_around.points.push_back({at, normal});
        const double turn = std::atan2(kFacing.y, kFacing.x) + kPi * ((i + 0.5) / azimuths - 0.5);
        in_front.points.push_back({at, {std::cos(turn), std::sin(turn), 0}});
    }
    const std::vector<Sensor> elements{{"around", all_around}, {"front", in_front}};
    const double factor = coarser(2);
    for (const std::string method : {"auto", "path"}) {
        const std::uint64_t paths = fewer(method == "auto" ? 1 << 16 : 1 << 12, 2);
        const RunResult bodies =
            measure(furnished(), bodies_at(at), body_options(method, fewer(1 << 17, 2), 11));
        const RunResult means = measure(furnished(), elements, body_options(method, paths, 12));
        for (std::size_t b = 0; b < 2; ++b) {
            const statistics::Estimate body = estimate(bodies, b), mean = means.sensors[b].summary.mean;
            EXPECT_LT(body.standard_error, 0.004 * factor * body.value) << method << " " << b;
            EXPECT_LT(mean.standard_error, 0.004 * factor * mean.value) << method << " " << b;
            EXPECT_LT(std::abs(z_score(body, mean)), 4) << method << " " << b;
        }
    }
}

/// Methods with patches are off by the patches only.
TEST(Bodies, PatchMethodsAgreeWithPathTracing) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.6));
    add_area_light(scene, Rectangle{{0.8, 0.5, 2.6}, {0, 1, 0}, {1.4, 0, 0}}, Rgb::grey(500));
    const std::vector<Sensor> bodies = bodies_at({1.2, 1.9, 1.3});
    const RunResult exact = measure(scene, bodies, body_options("auto", 1 << 17));
    for (const std::string method : {"ray-bundle", "radiosity", "particles"}) {
        RunOptions options = body_options(method, method == "particles" ? 1 << 19 : 1 << 13);
        options.patch_m = 0.45;
        const RunResult result = measure(scene, bodies, options);
        for (std::size_t b = 0; b < 4; ++b) {
            const double value = estimate(exact, b).value;
            EXPECT_NEAR(estimate(result, b).value, value, 0.02 * value) << method << " " << b;
        }
    }
}

/// Beside a grid on the same points: bodies and surface elements share packets of receivers.
TEST(Bodies, ShareARunWithSurfaceElements) {
    const Vec3 at{1.2, 1.9, 1.3};
    // No point lies in the face of the box: rays may start on either side there.
    std::vector<Sensor> together{{"desk", Grid{{0.2, 0.2, 0.8}, {3.4, 0, 0}, {0, 2.6, 0}, {3, 3}}}};
    for (const Sensor& body : bodies_at(at)) together.push_back(body);
    const std::vector<Sensor> desk(together.begin(), together.begin() + 1);
    const RunResult alone = measure(furnished(), desk, body_options("auto", 1 << 17, 21));
    const RunResult bodies = measure(furnished(), bodies_at(at), body_options("auto", 1 << 17, 22));
    const RunResult both = measure(furnished(), together, body_options("auto", 1 << 17, 23));
    for (std::size_t j = 0; j < desk[0].size(); ++j) {
        const statistics::Estimate a = both.sensors[0].readings[j].estimate;
        const statistics::Estimate b = alone.sensors[0].readings[j].estimate;
        EXPECT_LT(std::abs(z_score(a, b)), 4)
            << "reading " << j << ": " << a.value << " +- " << a.standard_error << " and " << b.value
            << " +- " << b.standard_error;
    }
    for (std::size_t b = 0; b < 4; ++b) {
        EXPECT_LT(std::abs(z_score(estimate(both, b + 1), estimate(bodies, b))), 4) << b;
    }
}

}  // namespace
}  // namespace stilb::run
