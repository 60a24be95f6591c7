// More lamps than are looked at one by one: no light is lost, by any method. Around the numbers at which
// another way is taken: kFew, kMost and kMostOpen are 32, kFewPoints and kChosen 16.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "estimators/estimator_list.h"
#include "exact/configuration_factors.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

const double kSide_m = 0.54;

Vec3 middle_of(int i) { return {1.0 + i % 10, 1.0 + i / 10, 6}; }
double strength_of(int i) { return 100.0 * (1 + i % 7); }
Rectangle panel(int i) {
    return {middle_of(i) - Vec3{kSide_m / 2, kSide_m / 2, 0}, {0, kSide_m, 0}, {kSide_m, 0, 0}};
}

/// A luminous intensity that makes an opening a uniform lamp.
PhotometricSolid lambertian() {
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0};
    for (int i = 0; i <= 180; ++i) {
        grid.polar_deg.push_back(i / 2.0);
        grid.intensity_cd.push_back(std::max(0.0, std::cos(i * kPi / 360)));
    }
    return PhotometricSolid(grid);
}

/// Adds lamp number `i`, and gives its illuminance.
using AddLamp = double (*)(Scene&, int, const exact::Receiver&);

double add_rectangle(Scene& scene, int i, const exact::Receiver& at) {
    const Rectangle p = panel(i);
    add_area_light(scene, p, Rgb::grey(strength_of(i)));
    return exact::illuminance_by_rectangle_lx(at, p.corner, p.edge_u, p.edge_v, strength_of(i));
}
double add_disk(Scene& scene, int i, const exact::Receiver& at) {
    const Disk disk{middle_of(i), {0, 0, -1}, 0.3};
    add_area_light(scene, disk, Rgb::grey(strength_of(i)));
    return exact::illuminance_by_disk_lx(at, {disk.center, disk.normal, disk.radius}, strength_of(i));
}
double add_sphere(Scene& scene, int i, const exact::Receiver& at) {
    add_area_light(scene, Sphere{middle_of(i), 0.2}, Rgb::grey(strength_of(i)));
    return exact::illuminance_by_sphere_lx(at, middle_of(i), 0.2, strength_of(i));
}
/// Of more triangles than have a closed form together.
double add_mesh(Scene& scene, int i, const exact::Receiver& at) {
    constexpr std::uint32_t strips = 20;
    const Rectangle p = panel(i);
    Mesh mesh;
    for (std::uint32_t k = 0; k <= strips; ++k) {
        const Vec3 low = p.corner + (k / double{strips}) * p.edge_u;
        mesh.vertices.insert(mesh.vertices.end(), {low, low + p.edge_v});
        if (k < strips)
            mesh.triangles.insert(mesh.triangles.end(),
                                  {{2 * k, 2 * k + 2, 2 * k + 3}, {2 * k, 2 * k + 3, 2 * k + 1}});
    }
    add_area_light(scene, mesh, Rgb::grey(strength_of(i)));
    return exact::illuminance_by_rectangle_lx(at, p.corner, p.edge_u, p.edge_v, strength_of(i));
}
double add_luminaire_with_opening(Scene& scene, int i, const exact::Receiver& at) {
    const Rectangle p = panel(i);
    const double luminance_cd_m2 = strength_of(i) / (kSide_m * kSide_m);
    add_opening(scene, middle_of(i), lambertian(), {lights::Opening::Form::box, {kSide_m, kSide_m, 0}},
                {0, 0, -1}, 0, Rgb::grey(strength_of(i)));
    return exact::illuminance_by_rectangle_lx(at, p.corner, p.edge_u, p.edge_v, luminance_cd_m2);
}
double add_point(Scene& scene, int i, const exact::Receiver& at) {
    add_point_light(scene, middle_of(i), Rgb::grey(strength_of(i)));
    return exact::illuminance_by_point_lx(at, middle_of(i), strength_of(i));
}
double add_mixed(Scene& scene, int i, const exact::Receiver& at) {
    const std::array<AddLamp, 6> all{
        add_rectangle, add_disk, add_sphere, add_mesh, add_luminaire_with_opening, add_point};
    return all[static_cast<std::size_t>(i) % all.size()](scene, i, at);
}

/// In a black hall, where all light is direct.
void expect_sum(const AddLamp& add, int count, std::string_view method) {
    const exact::Receiver at{{4.3, 2.6, 0.75}, normalized(Vec3{0.3, 0.2, 1})};
    Scene scene;
    add_object(scene, Box{{-1, -1, 0}, {12, 12, 6.5}}, diffuse(0));
    double sum_lx = 0;
    for (int i = 0; i < count; ++i) sum_lx += add(scene, i, at);
    const Sensor sensor = point_sensor({{at.position, at.normal}});
    RunOptions options;
    options.method = method;
    options.paths = method == "path" ? 32768 : 512;
    options.patch_m = 4;
    const RunResult result = measure(scene, {&sensor, 1}, options);
    const statistics::Estimate& found = result.sensors[0].readings[0].estimate;
    EXPECT_NEAR(found.value, sum_lx, 1e-3 * sum_lx + 4 * found.standard_error)
        << method << ", " << count << " lamps";
    EXPECT_LT(found.standard_error, 0.03 * sum_lx) << method << ", " << count << " lamps";
}

TEST(ManyLamps, OfEachKindLoseNoLight) {
    for (const auto& entry : estimators::estimator_list()) {
        for (const auto add : {add_rectangle, add_disk, add_sphere, add_mesh, add_luminaire_with_opening,
                               add_point, add_mixed}) {
            for (const int count : {32, 33}) expect_sum(add, count, entry.name);
        }
    }
}

TEST(ManyLamps, AtEveryThresholdLoseNoLight) {
    for (const char* method : {"auto", "local", "path"}) {
        for (const auto add : {add_rectangle, add_point, add_mixed}) {
            for (const int count : {1, 2, 4, 5, 15, 16, 17, 31, 63, 64, 65, 100})
                expect_sum(add, count, method);
        }
    }
}

/// A black hall would show direct light alone; this one shows what first shot makes of the lamps.
Scene grey_hall() {
    Scene scene;
    add_object(scene, Box{{-1, -1, 0}, {12, 12, 6.5}}, diffuse(0.5));
    return scene;
}

statistics::Estimate mean_of(const Scene& scene, std::string_view method, std::uint64_t paths) {
    const Sensor grid{"desk", Grid{{0, 0, 0.75}, {11, 0, 0}, {0, 11, 0}, {4, 4}}};
    RunOptions options;
    options.method = method;
    options.paths = paths;
    options.patch_m = 1.5;
    return measure(scene, {&grid, 1}, options).sensors[0].summary.mean;
}

/// `bias`: of patches, as a share.
void expect_light_of_paths(const Scene& scene, std::string_view method, double bias,
                           const std::string& what) {
    const auto right = mean_of(scene, "path", 4096);
    const auto found = mean_of(scene, method, method == "particles" ? 1 << 17 : 512);
    EXPECT_NEAR(found.value, right.value,
                bias * right.value + 4 * std::hypot(found.standard_error, right.standard_error))
        << method << ", " << what;
    EXPECT_LT(found.standard_error, 0.02 * right.value) << method << ", " << what;
}

TEST(ManyLamps, LightTheirSurroundingsByPatchesToo) {
    const exact::Receiver anywhere{{4.3, 2.6, 0.75}, {0, 0, 1}};
    const auto expect_light = [&](AddLamp add, int count, std::string_view method) {
        Scene scene = grey_hall();
        for (int i = 0; i < count; ++i) add(scene, i, anywhere);
        expect_light_of_paths(scene, method, 0.015, fmt::format("{} lamps", count));
    };
    for (const auto add : {add_rectangle, add_luminaire_with_opening, add_point})
        expect_light(add, 100, "ray-bundle");
    expect_light(add_sphere, 33, "ray-bundle");
    expect_light(add_mixed, 33, "ray-bundle");
    expect_light(add_mixed, 100, "particles");
}

/// A small lamp of as many vertices as first shot takes, of one less and of one more.
TEST(ManyLamps, OneOfManyVerticesLosesNoLight) {
    for (const std::uint32_t vertices : {31u, 32u, 33u}) {
        const std::uint32_t rim = vertices - 1;
        Mesh disk{{{5, 5, 6}}, {}};
        for (std::uint32_t i = 0; i < rim; ++i) {
            const double angle = -2 * kPi * i / rim;
            disk.vertices.push_back(Vec3{5, 5, 6} + 0.3 * Vec3{std::cos(angle), std::sin(angle), 0});
            disk.triangles.push_back({0, i + 1, (i + 1) % rim + 1});
        }
        Scene scene = grey_hall();
        add_area_light(scene, disk, Rgb::grey(1e5));
        RunOptions options;
        options.method = "ray-bundle";
        options.paths = 512;
        options.patch_m = 1.5;
        const Sensor point = point_sensor({{{5, 5, 0.75}, {0, 0, 1}}});
        const auto patches = measure(scene, {&point, 1}, options).patches;
        ASSERT_TRUE(patches);
        EXPECT_EQ(patches->lights[0].samples, vertices <= 32 ? vertices : 0u) << patches->lights[0].why;
        expect_light_of_paths(scene, "ray-bundle", 0.015, fmt::format("{} vertices", vertices));
    }
}

/// A picture of so many lamps on all patches would not fit into memory: this is said at once.
TEST(ManyLamps, ThatFillTheMemoryAreRefused) {
    Scene scene = grey_hall();
    for (int i = 0; i < 200'000; ++i)
        add_point_light(scene, {0.02 * (i % 500), 0.02 * (i / 500), 6}, Rgb::grey(1));
    const Sensor point = point_sensor({{{5, 5, 0.75}, {0, 0, 1}}});
    RunOptions options;
    options.method = "ray-bundle";
    options.paths = 512;
    options.patch_m = 0.2;
    try {
        measure(scene, {&point, 1}, options);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("200000 points"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace stilb::run
