#include "run/level_of_detail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "run/run.h"
#include "support/harmonic_shapes.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

Scene scene_with_head(bool with_levels) {
    Scene scene;
    Harmonics head(head_like_surface(32, 1));
    head.center = {0, 0, 1};
    head.scale = 0.2;
    head.has_levels_of_detail = with_levels;
    add_object(scene, head, diffuse(0.6));
    add_point_light(scene, {1, -2, 3}, Rgb::grey(100));
    return scene;
}

Sensor camera_at(double distance_m) {
    return {"view", Camera{{0, -distance_m, 1}, {0, 0, 1}, {0, 0, 1}, 20, {200, 200}, {}, {}}};
}

/// The largest difference of both surfaces along rays from their centre.
double largest_difference_m(const Scene& one, const Scene& other) {
    const auto& a = std::get<Harmonics>(one.objects[0].shape);
    const auto& b = std::get<Harmonics>(other.objects[0].shape);
    Numbers numbers(4);
    double largest = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec3 direction = numbers.direction();
        largest = std::max(largest, length(a.point_towards(direction) - b.point_towards(direction)));
    }
    return largest;
}

TEST(LevelOfDetail, IsWithinHalfAPixelAndKnowsItsError) {
    const Scene scene = scene_with_head(true);
    int degree_before = 33;
    for (const double distance_m : {2., 8., 32., 128.}) {
        const Sensor camera = camera_at(distance_m);
        const DetailedScene detailed = with_levels_of_detail(scene, {&camera, 1});
        ASSERT_EQ(detailed.levels.size(), 1u);
        const LevelOfDetail& level = detailed.levels[0];
        EXPECT_LT(level.degree, degree_before) << distance_m;
        degree_before = level.degree;
        const double pixel_m = distance_m * 2 * std::tan(10 * std::numbers::pi / 180) / 200;
        EXPECT_LE(level.allowed_m, 0.5 * pixel_m);
        EXPECT_GT(level.allowed_m, 0.4 * pixel_m * (distance_m - 0.3) / distance_m);
        EXPECT_LE(level.error_m, level.allowed_m);
        const double difference_m = largest_difference_m(scene, detailed.scene);
        EXPECT_LE(difference_m, level.error_m);
        EXPECT_GT(difference_m, 0.5 * level.error_m);  // and it is no more careful than it must be
    }
}

TEST(LevelOfDetail, LeavesObjectsThatDoNotAskForItAndNearOnes) {
    const Sensor far = camera_at(100), inside = camera_at(0.1);
    EXPECT_FALSE(has_levels_of_detail(scene_with_head(false)));
    EXPECT_TRUE(with_levels_of_detail(scene_with_head(false), {&far, 1}).levels.empty());
    const DetailedScene near = with_levels_of_detail(scene_with_head(true), {&inside, 1});
    EXPECT_EQ(near.levels[0].degree, 32);
    EXPECT_EQ(largest_difference_m(scene_with_head(false), near.scene), 0);
}

TEST(LevelOfDetail, HardlyChangesAPicture) {
    RunOptions options;
    options.method = "path";
    options.paths = 16;
    options.bounces = 1;
    const Sensor camera = camera_at(10);
    const RenderResult full = render(scene_with_head(false), camera, options);
    const RenderResult reduced = render(scene_with_head(true), camera, options);
    ASSERT_EQ(reduced.levels_of_detail.size(), 1u);
    EXPECT_LT(reduced.levels_of_detail[0].degree, 20);
    EXPECT_TRUE(full.levels_of_detail.empty());
    // The head is 23 pixels wide: half a pixel of its outline would be some 9 %.
    EXPECT_NEAR(reduced.mean_luminance_cd_m2, full.mean_luminance_cd_m2, 0.01 * full.mean_luminance_cd_m2);
}

}  // namespace
}  // namespace stilb::run
