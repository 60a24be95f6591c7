// Numbers of readings at which runs are made of other parts: both ways give the exact light.
//
//     campaign.cpp   kLargeGrid 64       readings of a grid: 32 replicates, or 8 whose errors are pooled
//                    kMostSums 2^22      readings x replicates x strands of each: four strands, or fewer
#include <gtest/gtest.h>

#include "exact/diffuse_cube.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

TEST(ReadingCounts, GridsOfFewAndOfManyReadings) {
    const double half_m = 2, flux_lm = 1000;
    const exact::DiffuseCube cube(2 * half_m, flux_lm);
    Scene scene;
    add_object(scene, Box{{-2, -2, -2}, {2, 2, 2}}, diffuse(0.5));
    add_point_light(scene, {0, 0, 0}, Rgb::grey(flux_lm / (4 * kPi)));
    for (const std::array<int, 2>& count : {std::array{9, 7}, {8, 8}, {13, 5}}) {
        const Sensor grid{"floor", Grid{{-1.5, -1.5, -2}, {3, 0, 0}, {0, 3, 0}, count, Vec3{0, 0, 1}}};
        const auto readings = static_cast<std::size_t>(count[0] * count[1]);
        for (const char* method : {"auto", "path", "light-paths"}) {
            RunOptions options;
            options.method = method;
            options.paths = 65536;
            const RunResult result = measure(scene, {&grid, 1}, options);
            EXPECT_EQ(result.replicates, readings < 64 ? 32 : 8) << readings;
            ASSERT_EQ(result.sensors[0].readings.size(), readings);
            std::size_t missed = 0;
            for (std::size_t i = 0; i < readings; ++i) {
                const Vec3 at = position_of(grid.measurand(i));
                const double exact_lx =
                    cube.direct_illuminance_lx(at.x, at.y) + cube.indirect_illuminance_lx(0.5, at.x, at.y);
                const statistics::Estimate& found = result.sensors[0].readings[i].estimate;
                // The exact value is known to 2e-4.
                EXPECT_NEAR(found.value, exact_lx, 5 * found.standard_error + 2e-4 * exact_lx)
                    << method << ", " << readings << " readings, " << i;
                EXPECT_GT(found.standard_error, 0) << method;
                EXPECT_LT(found.standard_error, 0.01 * exact_lx) << method;
                missed += found.lower > exact_lx * (1 + 2e-4) || found.upper < exact_lx * (1 - 2e-4);
            }
            EXPECT_LE(missed, readings / 5) << method << ", " << readings << " readings";
        }
    }
}

/// In a luminous cube a path's light does not depend on where it goes: sums that lack a strand, or have one
/// twice, are wrong by a third or a quarter.
TEST(ReadingCounts, FewerStrandsOfVeryManyReadings) {
    const double luminance = 100, reflectance = 0.2;
    Scene scene;
    add_area_light(scene, inward(Box{{0, 0, 0}, {2, 2, 2}}), Rgb::grey(luminance), diffuse(reflectance));
    const double exact_lx = kPi * luminance / (1 - reflectance);
    for (const int count : {131'072, 131'073}) {
        const Sensor grid{"row", Grid{{0.5, 0.5, 0.5}, {1, 0, 0}, {0, 1, 0}, {count, 1}, Vec3{0, 0, 1}}};
        RunOptions options;
        options.method = "path";
        options.paths = 8;
        const RunResult result = measure(scene, {&grid, 1}, options);
        EXPECT_EQ(result.replicates, 8);
        // A sample of each strand at least.
        EXPECT_EQ(result.samples % (count <= 131'072 ? 32 : 24), 0) << count;
        double sum_lx = 0, squares = 0;
        for (const Reading& reading : result.sensors[0].readings) {
            sum_lx += reading.estimate.value;
            squares += (reading.estimate.value - exact_lx) * (reading.estimate.value - exact_lx);
        }
        const double mean_lx = sum_lx / count;
        EXPECT_NEAR(mean_lx, exact_lx, 4 * std::sqrt(squares) / count) << count;
        EXPECT_LT(std::sqrt(squares / count), 0.5 * exact_lx) << count;
    }
}

}  // namespace
}  // namespace stilb::run
