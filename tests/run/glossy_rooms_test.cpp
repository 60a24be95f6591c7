// Readings close to surfaces that have no guess of the light, because all their reflection depends on
// direction: plastic and rough metal. Few connections to the residual would bring most of their light;
// gathering rays have to. Path tracing is the second method.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// A room, and beside it one whose lamp is `ratio` times as strong.
Scene two_rooms(const Material& surfaces, double ratio) {
    Scene scene;
    for (const double x : {0., 10.}) add_object(scene, Box{{x, 0, 0}, {x + 5, 4, 3}}, surfaces);
    add_area_light(scene, Sphere{{2, 3, 2.7}, 0.15}, Rgb::grey(3000));
    add_point_light(scene, {13, 2, 2.5}, Rgb::grey(ratio * 250));
    return scene;
}

TEST(GlossyRooms, AGuessFindsTheLightOfNearSurfacesWithoutOne) {
    const std::vector<MeasuringPoint> points{
        {{1, 1, 0.05}, {0, 0, -1}}, {{3.5, 2.5, 0.05}, {0, 0, -1}}, {{2, 3.95, 1}, {0, 1, 0}}};
    const std::vector sensors{point_sensor(points)};
    for (const auto& [name, surfaces] :
         std::vector<std::pair<std::string, Material>>{{"plastic", Plastic({Rgb::grey(0.5), 1.65, 0.23})},
                                                       {"rough", RoughConductor({Rgb::grey(0.6), 0.4})}}) {
        for (const double ratio : {1., 32.}) {
            const Scene scene = two_rooms(surfaces, ratio);
            RunOptions options;
            options.method = "path";
            options.paths = 30'000;
            const RunResult reference = measure(scene, sensors, options);
            options.method = "guided";
            options.paths = 3072;
            const RunResult found = measure(scene, sensors, options);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const statistics::Estimate& guided = found.sensors[0].readings[i].estimate;
                const statistics::Estimate& path = reference.sensors[0].readings[i].estimate;
                EXPECT_NEAR(guided.value, path.value,
                            4.5 * std::hypot(guided.standard_error, path.standard_error))
                    << name << ", ratio " << ratio << ", " << i;
                EXPECT_LT(guided.standard_error, 0.15 * path.value)
                    << name << ", ratio " << ratio << ", " << i;
            }
        }
    }
}

}  // namespace
}  // namespace stilb::run
