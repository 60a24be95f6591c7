// Runs that share a prepared scene give the bits of runs in the scene alone.
#include "run/prepared_scene.h"

#include <gtest/gtest.h>

#include <vector>

#include "run/run.h"
#include "run/solve.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// A carpet in the plane of the floor is a warning.
Scene scene_of(double size_m) {
    Scene scene;
    add_object(scene, triangulated(Box{{0, 0, 0}, {4, 3, 2.8}}), diffuse(0.7));
    add_object(scene, Rectangle{{1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, diffuse(0.2));
    add_object(scene, Rectangle{{-size_m, -size_m, -1}, {2 * size_m, 0, 0}, {0, 2 * size_m, 0}},
               diffuse(0.3));
    for (const double x : {1., 2., 3.}) add_point_light(scene, {x, 1.5, 2}, Rgb::grey(100));
    return scene;
}

Sensor sensor_at(const Vec3& position) { return point_sensor({{position, {0, 0, 1}}}); }

RunResult measured(const PreparedScene& scene, const Sensor& sensor) {
    RunOptions options;
    options.paths = 256;
    return measure(scene, std::vector{sensor}, options);
}

void expect_same(const RunResult& result, const RunResult& reference) {
    EXPECT_EQ(result.sensors[0].readings[0].estimate, reference.sensors[0].readings[0].estimate);
    EXPECT_EQ(result.warnings, reference.warnings);
    EXPECT_EQ(result.technique, reference.technique);
}

TEST(PreparedScene, GivesTheBitsOfTheSceneAlone) {
    // In the larger one, the centre of single precision lies where light is measured.
    for (const double size_m : {10., 1000.}) {
        const Scene scene = scene_of(size_m);
        const PreparedScene prepared(scene);
        for (const Sensor& sensor : {sensor_at({1, 1, 0.8}), sensor_at({3, 2, 0.8}),
                                     sensor_at({0.8 * size_m, 0, 0}), sensor_at({1, 1, 0.8})}) {
            const RunResult reference = measured(scene, sensor);
            EXPECT_FALSE(reference.warnings.empty());
            expect_same(measured(prepared, sensor), reference);
        }
    }
}

TEST(PreparedScene, ServesMeasurementsAfterSolutions) {
    const Scene scene = scene_of(10);
    const PreparedScene prepared(scene);
    RunOptions options;
    options.paths = 16;
    options.patch_m = 1;
    solve(prepared, options);
    const Sensor sensor = sensor_at({1, 1, 0.8});
    expect_same(measured(prepared, sensor), measured(scene, sensor));
}

TEST(PreparedScene, TakesOtherLights) {
    const Scene scene = scene_of(10);
    Scene relit = scene;
    relit.lights.erase(relit.lights.begin());
    const PreparedScene base(scene), prepared(relit, base);
    const Sensor sensor = sensor_at({1, 1, 0.8});
    expect_same(measured(prepared, sensor), measured(relit, sensor));
    expect_same(measured(base, sensor), measured(scene, sensor));
}

TEST(PreparedScene, BuildsTheAccelerationStructureOnce) {
    const Scene scene = scene_of(10), relit = scene;
    const PreparedScene base(scene), prepared(relit, base);
    const std::vector<Vec3> here{{1, 1, 0.8}}, there{{3, 2, 0.8}};
    const auto vertices = [](const PreparedScene& of, std::span<const Vec3> measured) {
        return of.caster(measured, Monitor::none())->traced_mesh(ObjectId{0})->vertices.data();
    };
    const auto* const known = vertices(base, here);
    EXPECT_EQ(vertices(base, there), known);
    EXPECT_EQ(vertices(prepared, there), known);
    EXPECT_EQ(base.findings(), base.findings());
}

}  // namespace
}  // namespace stilb::run
