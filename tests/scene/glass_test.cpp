#include "scene/glass.h"

#include <gtest/gtest.h>

#include <numbers>

#include "scene/dielectric.h"
#include "support/random_pairs.h"

namespace stilb {
namespace {

Vec3 incident(double degrees) {
    const double theta = degrees * std::numbers::pi / 180;
    return {std::sin(theta) * std::cos(0.7), std::sin(theta) * std::sin(0.7), std::cos(theta)};
}
double cosine(double degrees) { return incident(degrees).z; }

constexpr std::array<double, 7> kDegrees{0, 20, 40, 60, 80, 89, 89.9999};

TEST(Fresnel, HasTheKnownValues) {
    const double normal = fresnel_reflectance(1, 1.5).unpolarised();
    EXPECT_NEAR(normal, 0.04, 1e-15);
    EXPECT_NEAR(fresnel_reflectance(1, 1 / 1.5).unpolarised(), 0.04, 1e-15);
    // At Brewster's angle nothing of the light along the plane of incidence, of the other ((n2-1)/(n2+1))^2.
    const double brewster = std::cos(std::atan(1.5));
    EXPECT_NEAR(fresnel_reflectance(brewster, 1.5).p, 0, 1e-30);
    EXPECT_NEAR(fresnel_reflectance(brewster, 1.5).s, std::pow(1.25 / 3.25, 2), 1e-15);
    EXPECT_EQ(fresnel_reflectance(0, 1.5).unpolarised(), 1);
    EXPECT_EQ(fresnel_reflectance(0.3, 1).unpolarised(), 0);
    // Total reflection beyond asin(1/1.5) = 41.8 degrees.
    EXPECT_LT(fresnel_reflectance(cosine(41.8), 1 / 1.5).unpolarised(), 1);
    EXPECT_NEAR(fresnel_reflectance(cosine(41.9), 1 / 1.5).unpolarised(), 1, 1e-14);
}

TEST(Fresnel, IsTheSameInBothDirections) {
    for (const double degrees : kDegrees) {
        const double refracted = refracted_cosine(cosine(degrees), 1.5);
        EXPECT_NEAR(fresnel_reflectance(cosine(degrees), 1.5).s, fresnel_reflectance(refracted, 1 / 1.5).s,
                    1e-9);
        EXPECT_NEAR(fresnel_reflectance(cosine(degrees), 1.5).p, fresnel_reflectance(refracted, 1 / 1.5).p,
                    1e-9);
    }
}

TEST(GlassMaterial, KeepsAllLightAndObeysSnell) {
    RandomPairs random(3);
    for (const double degrees : kDegrees) {
        for (const GlassSide side : {GlassSide::outside, GlassSide::inside}) {
            const Vec3 in = incident(degrees);
            const double ior = side == GlassSide::outside ? 1.5 : 1 / 1.5;
            constexpr int kSamples = 20000;
            int mirrored = 0;
            for (int i = 0; i < kSamples; ++i) {
                const auto sample = sample_glass({1.5}, side, in, random.next());
                ASSERT_TRUE(sample);
                const Vec3& out = sample->scattered.direction;
                ASSERT_TRUE(sample->scattered.specular);
                ASSERT_EQ(sample->scattered.weight, Spectrum::grey(1));
                ASSERT_NEAR(length(out), 1, 1e-14);
                if (out.z > 0) {
                    ++mirrored;
                    ASSERT_EQ(sample->luminance_factor, 1);
                    continue;
                }
                ASSERT_NEAR(ior * std::hypot(out.x, out.y), std::hypot(in.x, in.y), 1e-12);
                ASSERT_NEAR(out.x * in.y, out.y * in.x, 1e-14);
                ASSERT_LT(out.x * in.x, 1e-300);
                ASSERT_NEAR(sample->luminance_factor, 1 / (ior * ior), 1e-15);
            }
            const double chance = fresnel_reflectance(in.z, ior).unpolarised();
            EXPECT_NEAR(mirrored, chance * kSamples, 5 * std::sqrt(chance * (1 - chance) * kSamples) + 1e-6);
        }
    }
}

TEST(GlassMaterial, LuminanceComesBackFromWithin) {
    // Back along the same way, seen in the frame of the inside, whose z points the other way.
    const Vec3 in = incident(50);
    const auto entered = sample_glass({1.7}, GlassSide::outside, in, 0.999);
    ASSERT_TRUE(entered);
    const Vec3& down = entered->scattered.direction;
    ASSERT_LT(down.z, 0);
    const auto left = sample_glass({1.7}, GlassSide::inside, {down.x, down.y, -down.z}, 0.999);
    ASSERT_TRUE(left);
    EXPECT_LT(length(left->scattered.direction - Vec3{in.x, in.y, -in.z}), 1e-14);
    EXPECT_NEAR(entered->luminance_factor * left->luminance_factor, 1, 1e-14);
}

TEST(PaneMaterial, HasTheTransmittancesOfWindowGlass) {
    const Pane pane{1.52, Spectrum::grey(0.96)};
    EXPECT_NEAR(pane_shares(pane, 1).transmittance[1], 0.8815, 5e-5);
    EXPECT_NEAR(pane_shares(pane, 0.5).transmittance[1], 0.8015, 5e-5);
}

TEST(PaneMaterial, KeepsAllLightWhereNothingIsAbsorbedInside) {
    for (const double degrees : kDegrees) {
        for (const double ior : {1.0, 1.3, 1.52, 2.5}) {
            const PaneShares clear = pane_shares({ior, Spectrum::grey(1)}, cosine(degrees));
            const PaneShares grey = pane_shares({ior, {{0.9, 0.5, 0.1}}}, cosine(degrees));
            for (std::size_t b = 0; b < kBands; ++b) {
                EXPECT_NEAR(clear.reflectance[b] + clear.transmittance[b], 1, 1e-12);
                EXPECT_LT(grey.reflectance[b] + grey.transmittance[b], 1);
                EXPECT_GE(grey.reflectance[b], 0);
            }
        }
    }
    EXPECT_EQ(pane_shares({}, 0).reflectance, Spectrum::grey(1));
}

TEST(PaneMaterial, SamplesHaveItsSharesAsTheirMean) {
    const Pane pane{1.52, {{0.9, 0.8, 0.3}}};
    for (const double degrees : kDegrees) {
        const Vec3 in = incident(degrees);
        const PaneShares shares = pane_shares(pane, in.z);
        constexpr int kSteps = 100'000;
        Spectrum mirrored, passed;
        for (int i = 0; i < kSteps; ++i) {
            const auto sample = sample_pane(pane, in, (i + 0.5) / kSteps);
            ASSERT_TRUE(sample && sample->specular);
            const bool back = sample->direction.z > 0;
            ASSERT_LT(length(sample->direction - (back ? reflected(in, {0, 0, 1}) : -in)), 1e-15);
            (back ? mirrored : passed) += sample->weight * (1.0 / kSteps);
        }
        for (std::size_t b = 0; b < kBands; ++b) {
            EXPECT_NEAR(mirrored[b], shares.reflectance[b], 1e-4);
            EXPECT_NEAR(passed[b], shares.transmittance[b], 1e-4);
        }
    }
}

TEST(GlassMaterials, ReflectNothingFromBelow) {
    EXPECT_FALSE(sample_glass({1.5}, GlassSide::outside, {0, 0, -1}, 0.5));
    EXPECT_FALSE(sample_pane({}, {0, 0, -1}, 0.5));
}

}  // namespace
}  // namespace stilb
