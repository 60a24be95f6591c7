// What methods for diffuse scenes light patches with: the balance of its flux.
#include <gtest/gtest.h>

#include <cmath>

#include "estimators/patch_light/particles/particles.h"
#include "estimators/patch_light/radiosity/radiosity.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"
#include "materials/diffuse.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

constexpr Rgb kReflectance{{0.8, 0.5, 0.2}};
constexpr Rgb kFlux_lm{{3000, 2000, 1000}};

/// A closed room with a box in it, all of one material, lit by a point and by a large light.
Scene closed_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, Diffuse{kReflectance});
    add_object(scene, Box{{2, 1, 0.5}, {3, 2, 1.5}}, Diffuse{kReflectance});
    add_point_light(scene, {1, 1, 1.5}, kFlux_lm * (0.5 / (4 * std::numbers::pi)));
    add_area_light(scene, Rectangle{{0.2, 0.2, 2.4}, {0, 2, 0}, {1.5, 0, 0}},
                   kFlux_lm * (0.5 / (3 * std::numbers::pi)), Diffuse{kReflectance});
    return scene;
}

/// What all sides absorb [lm], by what they reflect.
Rgb absorbed_lm(const PatchTransport& transport, const std::vector<FloatRgb>& reflected_cd_m2) {
    Rgb sum;
    for (std::uint32_t side = 0; side < reflected_cd_m2.size(); ++side) {
        const double area_m2 = double{transport.patches.areas_m2[transport.patches.patch_of(side)]};
        for (std::size_t b = 0; b < kBands; ++b) {
            sum[b] +=
                std::numbers::pi * area_m2 * double{reflected_cd_m2[side][b]} * (1 / kReflectance[b] - 1);
        }
    }
    return sum;
}

class LitRoom : public testing::Test {
  protected:
    LitRoom() {
        options_.patch_m = 0.6;
        options_.shot_resolution = 32;
    }

    Scene scene_ = closed_room();
    rays::RayCaster caster_{scene_};
    PatchOptions options_;
};

/// A walk that starts in darkness lacks r^n of the light after n steps: as a mean over as many more,
/// r^m / (m (1 - r)).
TEST(RayBundles, LeaveOutTheStepsThatLackLight) {
    const auto steps = [](double reflectance) {
        Scene scene;
        add_object(scene, Box{{0, 0, 0}, {4, 4, 4}}, Diffuse{Rgb::grey(reflectance)});
        add_point_light(scene, {2, 2, 2}, Rgb::grey(1));
        const rays::RayCaster caster(scene);
        PatchOptions options;
        options.patch_m = 2;
        return first_steps(PatchTransport(scene, caster, options));
    };
    for (const double r : {0.5, 0.99, 0.999, 0.9993}) {
        const auto m = static_cast<double>(steps(r));
        EXPECT_LT(std::pow(r, m) / (m * (1 - r)), 1.0001e-3) << r;
        EXPECT_LT(m, 8192) << r;
    }
    EXPECT_THROW(steps(0.9994), InputError);
    EXPECT_THROW(steps(1), InputError);
}

TEST_F(LitRoom, AbsorbsWhatRadiositySends) {
    const PatchTransport transport(scene_, caster_, options_);
    ASSERT_FALSE(transport.first_shot.replaces(1));  // the light is large
    const RadiositySolution solution = solve_radiosity(transport);
    const Rgb absorbed =
        absorbed_lm(transport, solution.light.cd_m2()) + absorbed_lm(transport, transport.first_reflection);
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(absorbed[b], kFlux_lm[b], 0.003 * kFlux_lm[b]) << b;
}

TEST_F(LitRoom, AbsorbsAllParticles) {
    options_.first_shot.variant = FirstShotVariant::none;
    const PatchTransport transport(scene_, caster_, options_);
    IlluminationMap map(transport);
    map.add(math::RandomKey{1}, 0, 1 << 16);
    const Rgb absorbed = absorbed_lm(transport, map.reflected_cd_m2());
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(absorbed[b], kFlux_lm[b], 0.005 * kFlux_lm[b]) << b;
}

}  // namespace
}  // namespace stilb::estimators
