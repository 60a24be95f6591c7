#include "transport/light_choice.h"

#include <gtest/gtest.h>

#include <vector>

#include "statistics/hypothesis.h"
#include "support/scene_builder.h"
#include "transport/light_sampler.h"

namespace stilb::transport {
namespace {

constexpr int kChoices = 20'000;

/// Lamps in two rows, and the sky as the light in the middle.
struct Chosen {
    Chosen(std::uint32_t lamps, bool has_sky) {
        for (std::uint32_t i = 0; i < lamps; ++i) {
            if (has_sky && i == lamps / 2) add_sky(scene);
            add_point_light(scene, {0.5 * i, 0.3 * (i % 2), 3}, Rgb::grey(1 + i % 7));
        }
        caster.emplace(scene);
        lights.emplace(scene, *caster);
        std::vector<LightTree::Light> all = lights->leaves(scene, [](std::uint32_t) { return true; });
        choice = {std::move(all), has_sky ? std::optional(lights->light_from_outside()) : std::nullopt};
    }

    Scene scene;
    std::optional<rays::RayCaster> caster;
    std::optional<LightSampler> lights;
    LightChoice choice;
};

/// Few lights and many, with the sky and without it: each is chosen as often as is said, and what is left of
/// the random number is even.
TEST(LightChoice, IsAsProbableAsItSays) {
    for (const bool has_sky : {false, true}) {
        for (const std::uint32_t lamps : {5u, 31u, 32u, 33u, 90u}) {
            const Chosen chosen(lamps, has_sky);
            const SurfacePoint floor{{4, 1, 0}, normalized(Vec3{0.1, 0, 1})};
            const LightChoice::At at(chosen.choice, *chosen.lights, floor);
            std::vector<double> expected, observed(chosen.scene.lights.size()), remainders;
            double sum = 0;
            for (std::uint32_t light = 0; light < observed.size(); ++light) {
                expected.push_back(kChoices * at.times_probability(1, light));
                sum += expected.back();
            }
            EXPECT_NEAR(sum, kChoices, 1e-9 * kChoices);
            for (int i = 0; i < kChoices; ++i) {
                const double u = math::SampleStream(math::RandomKey{3}.derived(i), 0).next();
                const math::DiscreteChoice one = at.choose(u);
                ASSERT_NEAR(kChoices * one.probability, expected[one.index], 1e-9 * kChoices);
                ++observed[one.index];
                remainders.push_back(one.remainder);
            }
            EXPECT_GT(statistics::chi2_test(observed, expected).p_value, 1e-4) << lamps << has_sky;
            EXPECT_GT(statistics::uniformity_p(remainders), 1e-4) << lamps << has_sky;
        }
    }
}

/// Even choices take each light as often as is its expected number, but for one.
TEST(LightChoice, IsEvenOverManyChoices) {
    constexpr std::uint32_t kMany = 500;
    const Chosen chosen(40, true);
    const SurfacePoint floor{{10, 0, 0}, {0, 0, 1}};
    const LightChoice::At at(chosen.choice, *chosen.lights, floor);
    std::vector<int> times(chosen.scene.lights.size());
    choose_evenly(at, kMany, 0.3, [&](const math::DiscreteChoice& one, double expected) {
        EXPECT_NEAR(expected, kMany * at.times_probability(1, static_cast<std::uint32_t>(one.index)), 1e-9);
        ++times[one.index];
    });
    for (std::uint32_t light = 0; light < times.size(); ++light)
        EXPECT_LT(std::abs(times[light] - kMany * at.times_probability(1, light)), 1) << light;
}

TEST(LightChoice, IsEmptyWhereNoLightArrives) {
    for (const std::uint32_t lamps : {5u, 90u}) {
        const Chosen chosen(lamps, false);
        const SurfacePoint ceiling{{4, 1, 4}, {0, 0, 1}};
        const LightChoice::At at(chosen.choice, *chosen.lights, ceiling);
        EXPECT_TRUE(at.is_empty());
        EXPECT_EQ(at.times_probability(1, 2), 0);
    }
    EXPECT_TRUE(LightChoice().is_empty());
}

TEST(DirectSample, StartsOffTheSurfaceAndHasTheCosine) {
    const SurfacePoint at{{0, 0, 0}, {0, 0, 1}, {0, 0, 1e-3}};
    const Vec3 towards = normalized(Vec3{0, 3, 4});
    const lights::IncidentLight light{{0, 3, 4}, towards, Rgb::grey(10), 1};
    const auto sample = direct_sample(light, at);
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->segment.from, at.lifted);
    EXPECT_EQ(sample->segment.to, light.source_point);
    EXPECT_NEAR(sample->illuminance_lx.luminance(), 8, 1e-12);
    EXPECT_FALSE(direct_sample(light, {{0, 0, 0}, {0, 0, -1}}));
    EXPECT_FALSE(direct_sample(std::nullopt, at));
    EXPECT_FALSE(direct_sample(lights::IncidentLight{{0, 3, 4}, towards, {}, 1}, at));
}

/// A point without a surface starts rays itself, and receives light from all sides.
TEST(SurfacePoint, InTheOpenIsItsOwnStartOfRays) {
    const SurfacePoint open{{1, 2, 3}}, on_floor{{1, 2, 0}, {0, 0, 1}, {1, 2, 1e-3}};
    EXPECT_EQ(open.lifted, open.position);
    EXPECT_TRUE(open.is_in_open());
    EXPECT_FALSE(on_floor.is_in_open());
}

}  // namespace
}  // namespace stilb::transport
