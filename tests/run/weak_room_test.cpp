// Two closed rooms, the lamp of one much weaker than that of the other: light in the weak room is exact, by
// every way of choosing among lamps and surfaces. The ratios lie around
//
//     weak_lights.cpp      kComparable 16    lamps that are weak beside others
//     residual_light.cpp   kWeakSide 0.1     sides of the guess that get favour: a ratio of about 5e-3
#include <gtest/gtest.h>

#include <cmath>

#include "exact/diffuse_cube.h"
#include "run/run.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

TEST(WeakRoom, HasItsLightWhateverTheRatioOfTheLamps) {
    const double factor = coarser(2);
    const double side_m = 4, strong_lm = 1e6, reflectance = 0.5;
    const exact::DiffuseCube cube(side_m, 1);
    const std::vector<std::array<double, 2>> places{{0.1, 0.2}, {1.2, -0.7}, {1.7, 1.5}};
    std::vector<MeasuringPoint> points;
    for (const auto& [x, y] : places) points.push_back({{x, y, -side_m / 2}, {0, 0, 1}});
    for (const double ratio : {1 / 15.9, 1. / 16, 1 / 16.1, 2e-2, 6e-3, 4e-3, 2e-4, 1e-5}) {
        Scene scene;
        for (const auto& [x, flux_lm] : {std::pair(0.0, ratio * strong_lm), {10.0, strong_lm}}) {
            add_object(scene, Box{{x - 2, -2, -2}, {x + 2, 2, 2}}, diffuse(reflectance));
            add_point_light(scene, {x, 0, 0}, Rgb::grey(flux_lm / (4 * kPi)));
        }
        for (const char* method : {"path", "light-paths", "guided", "auto"}) {
            RunOptions options;
            options.method = method;
            options.paths = fewer(16384, 2);
            const RunResult result = measure(scene, std::vector{point_sensor(points)}, options);
            for (std::size_t i = 0; i < places.size(); ++i) {
                const auto [x, y] = places[i];
                const double exact_lx =
                    ratio * strong_lm *
                    (cube.direct_illuminance_lx(x, y) + cube.indirect_illuminance_lx(reflectance, x, y));
                const statistics::Estimate& found = result.sensors[0].readings[i].estimate;
                EXPECT_NEAR(found.value, exact_lx, 4.5 * found.standard_error + 2e-4 * exact_lx)
                    << method << ", ratio " << ratio << ", " << i;
                EXPECT_LT(found.standard_error, 0.04 * factor * exact_lx) << method << ", ratio " << ratio;
                EXPECT_GT(found.standard_error, 0) << method << ", ratio " << ratio;
            }
        }
    }
}

}  // namespace
}  // namespace stilb::run
