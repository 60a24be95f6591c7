// Light through small holes in the walls of rooms of all sizes, against its closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "exact/configuration_factors.h"
#include "materials/black.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kSky_cd_m2 = 1000;

/// A black room with a square hole in a wall, outside of which it is bright, and a point that faces the hole
/// from half its width.
struct RoomWithHole {
    Scene scene;
    MeasuringPoint point;
    double exact_lx = 0;

    /// `others`: black things elsewhere in the room.
    RoomWithHole(double side_m, double hole_m, int others) {
        const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
        const double y0 = 0.37 * side_m, z0 = 0.41 * side_m, y1 = y0 + hole_m, z1 = z0 + hole_m;
        const auto add = [&](const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v) {
            add_object(scene, Rectangle{corner, edge_u, edge_v}, Black{});
        };
        const Box room{{}, {side_m, side_m, side_m}};
        for (std::size_t i = 1; i < 6; ++i)
            add_object(scene, wall(room, i / 2, i % 2 == 0 ? Side::low : Side::high), Black{});
        add({}, y0 * y, side_m * z);
        add({0, y1, 0}, (side_m - y1) * y, side_m * z);
        add({0, y0, 0}, hole_m * y, z0 * z);
        add({0, y0, z1}, hole_m * y, (side_m - z1) * z);
        for (int i = 0; i < others; ++i)
            add({side_m / 2, 0.015 * side_m * (i + 1), 0.1 * side_m}, 0.003 * side_m * x, 0.003 * side_m * y);
        add_environment(scene, Rgb::grey(kSky_cd_m2));
        point = {{hole_m / 2, y0 + hole_m / 2, z0 + hole_m / 2}, -x};
        exact_lx = exact::illuminance_by_rectangle_lx({point.position, point.normal}, {0, y0, z0}, hole_m * y,
                                                      hole_m * z, kSky_cd_m2);
    }
};

/// In scenes of few triangles and of many, whose rays are found in different ways.
TEST(SmallHoles, LetAllOfTheirLightIn) {
    RunOptions options;
    options.method = "path";
    options.paths = 1 << 18;
    const auto relative = [&](const RoomWithHole& room) {
        const std::vector<Sensor> sensors{point_sensor({room.point})};
        const RunResult result = measure(room.scene, sensors, options);
        statistics::Estimate e = result.sensors[0].readings[0].estimate;
        e.value /= room.exact_lx, e.standard_error /= room.exact_lx;
        return e;
    };
    // All rooms have the same random numbers, so the noise of all is that of the first.
    const statistics::Estimate first = relative({1, 0.25, 0});
    EXPECT_NEAR(first.value, 1, 4 * first.standard_error);
    EXPECT_LT(first.standard_error, 2e-4);
    for (const double side_m : {1.0, 6.0, 60.0, 1000.0}) {
        for (const double hole_m : {0.001, 0.03, 1.0}) {
            if (hole_m >= side_m / 2) continue;
            for (const int others : {0, 50}) {
                EXPECT_NEAR(relative({side_m, hole_m, others}).value, first.value, 1e-4)
                    << fmt::format("hole of {} m, room of {} m, {} others", hole_m, side_m, others);
            }
        }
    }
}

}  // namespace
}  // namespace stilb::run
