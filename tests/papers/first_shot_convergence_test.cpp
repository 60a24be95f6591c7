#include "papers/first_shot_convergence.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>

#include "materials/diffuse.h"
#include "support/scene_builder.h"
#include "transport/receiver.h"

namespace stilb::papers {
namespace {

/// The limit of time is over at the first look already.
TEST(FirstShotConvergence, ShownMethodsAreSeenUntilTheirLastStep) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, Diffuse{Rgb::grey(0.5)});
    add_point_light(scene, {2, 1.5, 2}, Rgb::grey(100));
    const rays::RayCaster caster(scene);
    const transport::LightSampler lights(scene, caster);
    const estimators::PictureTracing tracing(
        {.scene = scene,
         .caster = caster,
         .max_reflections = transport::kUnlimited,
         .preparation_key = {math::RandomKey{1}},
         .camera = Camera{{0.3, 0.3, 1.5}, {2.5, 1.6, 0.7}, {0, 0, 1}, 70, {12, 8}, Projection::perspective}},
        lights);
    estimators::PatchOptions options;
    options.patch_m = 1;
    options.first_shot.variant = estimators::FirstShotVariant::incoming;
    constexpr int steps = 20;
    std::map<std::string, int> last_seen;
    const auto curves =
        converge(tracing, {{"shown", options, true}, {"other", options, false}}, steps, 0,
                 [&](const ConvergenceState& state) { last_seen[state.method.name] = state.steps; });
    EXPECT_EQ(last_seen["shown"], steps);
    EXPECT_EQ(curves[0].points.back().steps, steps);
    EXPECT_EQ(last_seen["other"], 1);
    EXPECT_EQ(curves[1].points.size(), 1u);
    EXPECT_LT(curves[0].points.back().error, 0.2) << "of the light of the same patches";
    EXPECT_GT(curves[0].points.back().error, 0);
    estimators::PatchOptions finer = options;
    finer.patch_m = 0.5;
    EXPECT_THROW(converge(tracing, {{"shown", options, true}, {"finer", finer, true}}, steps, 0,
                          [](const ConvergenceState&) {}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace stilb::papers
