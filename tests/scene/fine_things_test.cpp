// Things are fine by their size beside the scene's and by their distance from measured points.
#include "scene/fine_things.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "materials/black.h"
#include "support/scene_builder.h"

namespace stilb::scene {
namespace {

TEST(FineThings, AreSmallBesideTheSceneAndNearToAPoint) {
    // 10,000 times the rounding error of the largest coordinate, of 32 m at most.
    for (const double half_m : {0.5, 3.0, 31.0, 32.0, 33.0, 1e6}) {
        const double coarse_m = 1e4 * 0x1p-24 * std::min(half_m, 32.0);
        const auto sees = [&](double edge_m, double distance_m) {
            Scene scene;
            add_object(scene, Box{{-half_m, -half_m, -half_m}, {half_m, half_m, half_m}}, Black{});
            add_object(scene, Rectangle{{0, 0, 0}, {edge_m, 0, 0}, {0, 0.1, 0}}, Black{});
            const std::vector<Vec3> points{{0.1, 0.1, 0.1}, {0, 0, distance_m}};
            return sees_fine_things(scene, points);
        };
        EXPECT_TRUE(sees(0.999 * coarse_m, 0)) << half_m;
        EXPECT_FALSE(sees(1.001 * coarse_m, 0)) << half_m;
        EXPECT_TRUE(sees(0.5 * coarse_m, 7.99 * 0.5 * coarse_m)) << half_m;
        EXPECT_FALSE(sees(0.5 * coarse_m, 8.01 * 0.5 * coarse_m)) << half_m;
    }
}

}  // namespace
}  // namespace stilb::scene
