// The ceiling of a mesh as its lamp lights the room as a rectangle of its own does, by every method.
#include "scene/cut_lamps.h"

#include <gtest/gtest.h>

#include "estimators/estimator_list.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr Box kRoom{{0, 0, 0}, {4, 3, 2.5}};
const Rgb kLuminance = Rgb::grey(500);

Scene room_of_rectangles() {
    Scene scene;
    for (std::size_t i = 0; i < 6; ++i)
        add_object(scene, wall(kRoom, i / 2, i % 2 == 0 ? Side::low : Side::high), diffuse(0.5));
    scene.lights.push_back({"ceiling", AreaLight{ObjectId{5}, kLuminance}});
    return scene;
}

Scene room_of_one_mesh() {
    Scene scene;
    const ObjectId room = add_object(scene, inward(kRoom), diffuse(0.5));
    const auto& mesh = std::get<Mesh>(scene.object(room).shape);
    std::vector<std::uint32_t> ceiling;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        if (mesh.vertices[a].z + mesh.vertices[b].z + mesh.vertices[c].z == 3 * kRoom.max.z)
            ceiling.push_back(t);
    }
    const ObjectId lamp = scene::cut_out(scene, room, ceiling, "room (ceiling)");
    scene.lights.push_back({"ceiling", AreaLight{lamp, kLuminance}});
    return scene;
}

std::vector<statistics::Estimate> readings_under_cut_lamps(const Scene& scene, const Sensor& sensor,
                                                           std::string_view method, std::uint64_t seed) {
    RunOptions options;
    options.method = method;
    options.paths = 256;
    options.seed = seed;
    options.patch_m = 0.8;
    std::vector<statistics::Estimate> readings;
    const RunResult result = measure(scene, {&sensor, 1}, options);
    for (const Reading& reading : result.sensors[0].readings) readings.push_back(reading.estimate);
    return readings;
}

/// Both rooms by one method, with seeds of their own.
void expect_equal(const Sensor& sensor, std::string_view method) {
    const auto mesh = readings_under_cut_lamps(room_of_one_mesh(), sensor, method, 1),
               rectangles = readings_under_cut_lamps(room_of_rectangles(), sensor, method, 2);
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        // Intervals contain the error of patches, for methods that have them.
        const double error =
            std::hypot(mesh[i].upper - mesh[i].lower, rectangles[i].upper - rectangles[i].lower);
        EXPECT_NEAR(mesh[i].value, rectangles[i].value, error + 1e-6 * rectangles[i].value)
            << method << ' ' << i;
    }
}

TEST(CutLamps, LightTheRoomAsRectanglesDo) {
    const Sensor sensor =
        point_sensor({{{2, 1, 0.75}, {0, 0, 1}}, {{0.2, 0.2, 0}, {0, 0, 1}}, {{4, 1.5, 2.3}, {-1, 0, 0}}});
    for (const auto& entry : estimators::estimator_list()) expect_equal(sensor, entry.name);
}

/// A lamp reflects light, too: its luminance is the emitted one and more.
TEST(CutLamps, AreSeen) {
    const Sensor sight{"sight", Luminance{{LineOfSight{{1, 1, 1}, normalized({0.3, 0.2, 1})}}}};
    for (const std::string_view method : estimators::luminance_methods()) expect_equal(sight, method);
    EXPECT_GT(readings_under_cut_lamps(room_of_one_mesh(), sight, "path", 1)[0].lower,
              1.05 * kLuminance.luminance());
}

}  // namespace
}  // namespace stilb::run
