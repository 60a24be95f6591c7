// Rough clear interfaces: published and exact albedos, samplers, and what holds between both sides.
#include "materials/frosted.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "materials/glazing.h"
#include "materials/material.h"
#include "materials/straight.h"
#include "math/sampling.h"
#include "support/direction_grid.h"
#include "support/random_pairs.h"

namespace stilb::materials {
namespace {

Vec3 at_cosine(double cosine) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    return {sine * std::cos(0.7), sine * std::sin(0.7), cosine};
}

/// What facets send on at once, by samples of the height-correlated and the separable masking (1500 x 1500).
struct Known {
    double roughness, cosine, reflected_outside, transmitted_outside, reflected_inside, transmitted_inside;
};
constexpr std::array<Known, 12> kKnown{{{.1, 1, .03964, .95923, .04264, .94632},
                                        {.1, .5, .08588, .90636, .94034, .02304},
                                        {.1, .1, .31161, .60986, .85728, .00581},
                                        {.3, 1, .03560, .95281, .04875, .85073},
                                        {.3, .5, .06098, .88635, .65374, .12968},
                                        {.3, .1, .14948, .71433, .76391, .01668},
                                        {.5, 1, .02817, .93994, .04616, .70772},
                                        {.5, .5, .04394, .83976, .43450, .21762},
                                        {.5, .1, .09962, .62019, .64865, .02139},
                                        {1, 1, .01270, .88064, .02571, .39140},
                                        {1, .5, .02339, .65142, .18012, .29361},
                                        {1, .1, .05847, .36103, .43067, .02554}}};

TEST(Facets, SendOnWhatIsKnown) {
    for (const auto& [roughness, cosine, r_outside, t_outside, r_inside, t_inside] : kKnown) {
        const FacetAlbedos outside(FacetSide{1.5, roughness}), inside(FacetSide{1 / 1.5, roughness});
        const std::string what = fmt::format("alpha {} at {}", roughness, cosine);
        EXPECT_NEAR(outside.reflected.at(cosine), r_outside, 0.001) << what;
        EXPECT_NEAR(outside.transmitted.at(cosine), t_outside, 0.002) << what;
        EXPECT_NEAR(inside.reflected.at(cosine), r_inside, 0.002) << what;
        EXPECT_NEAR(inside.transmitted.at(cosine), t_inside, 0.002) << what;
    }
    // Without Fresnel's factor: 1 - ln 2 [Heitz 2014].
    const FacetAlbedos rough(FacetSide{1.5, 1, true});
    EXPECT_NEAR(rough.reflected.at(1) + rough.transmitted.at(1), 1 - std::log(2), 0.001);
}

std::vector<Frosted> glasses() {
    std::vector<Frosted> all;
    for (const double roughness : {0.05, 0.4, 1.0}) {
        for (const double ior : {1.2, 2.0}) {
            all.emplace_back(Frosted::Parameters{ior, roughness, false});
            all.emplace_back(Frosted::Parameters{ior, roughness, true});
        }
    }
    return all;
}

std::string name_of(const Frosted& glass) {
    const auto& [ior, roughness, thin, outside_ior] = glass.parameters();
    return fmt::format("{} {}, alpha {}", thin ? "sheet" : "solid", ior, roughness);
}

TEST(Frosted, KeepsAllLightOnBothSides) {
    constexpr int kSteps = 256;
    RandomPairs random(12);
    for (const Frosted& glass : glasses()) {
        for (const LightSide side : {LightSide::outside, LightSide::inside}) {
            for (const double cosine : {1.0, 0.8, 0.5, 0.2, 0.05}) {
                double sum = 0, stated = 0;
                for (const Lobe& lobe : glass.lobes(side, Carried::flux)) {
                    stated += sent_on(lobe.scattering, cosine)[0];
                    for (int i = 0; i < kSteps * kSteps; ++i) {
                        const auto [u1, u2] = random.next_pair();
                        const auto sample =
                            sample_brdf(lobe.scattering, at_cosine(cosine), (i % kSteps + u1) / kSteps,
                                        (i / kSteps + u2) / kSteps);
                        if (sample) sum += sample->weight[0] * lobe.factor(Carried::flux) / (kSteps * kSteps);
                    }
                }
                EXPECT_NEAR(sum, 1, 0.004) << name_of(glass) << " at " << cosine;
                EXPECT_NEAR(stated, 1, 0.002) << name_of(glass) << " at " << cosine;
            }
        }
    }
}

TEST(Frosted, VanishesInAMediumOfItsOwnKind) {
    const auto is_seen = [](double excess) {
        const Frosted body({1.5, 0.3, false, 1.5 / (1 + excess)});
        return !body.lobes(LightSide::outside, Carried::flux)[0].scattering.is<Straight>();
    };
    for (const double sign : {1.0, -1.0}) {
        EXPECT_FALSE(is_seen(0.99e-4 * sign));
        EXPECT_TRUE(is_seen(1.01e-4 * sign));
    }
    EXPECT_FALSE(is_seen(0));
}

/// f / n'^2 is the same in both directions: so is what lies between the factors of flux and luminance.
TEST(Frosted, IsTheSameFromBothSides) {
    RandomPairs random(3);
    for (const Frosted& glass : glasses()) {
        const auto crossing = [&](LightSide side, Carried carried) { return glass.lobes(side, carried)[1]; };
        const Lobe out_flux = crossing(LightSide::outside, Carried::flux),
                   in_flux = crossing(LightSide::inside, Carried::flux),
                   out_seen = crossing(LightSide::outside, Carried::luminance);
        EXPECT_NEAR(out_flux.far_over_near * in_flux.far_over_near, 1, 1e-12);
        int compared = 0;
        for (int i = 0; i < 2000; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Vec3 from = math::sample_cosine_hemisphere(u1, u2).direction;
            const auto [u3, u4] = random.next_pair();
            const auto sample = sample_brdf(out_flux.scattering, from, u3, u4);
            if (!sample) continue;
            const Vec3& to = sample->direction;
            const double forward = evaluate_brdf_per_sr(out_flux.scattering, from, to)[0];
            const double backward = evaluate_brdf_per_sr(in_flux.scattering, to, from)[0];
            ASSERT_NEAR(forward, backward, 1e-9 * forward) << name_of(glass);
            // A walk against the light from the outside: the light comes from the inside.
            ASSERT_NEAR(evaluate_brdf_per_sr(out_seen.scattering, to, from)[0], forward, 1e-9 * forward);
            ++compared;
        }
        EXPECT_GT(compared, 1000);
    }
}

TEST(Frosted, SamplesFollowTheirDensity) {
    double least_p = 1;
    int compared = 0;
    for (const Frosted& glass : glasses()) {
        if (glass.parameters().roughness < 0.3) continue;
        for (const LightSide side : {LightSide::outside, LightSide::inside}) {
            for (const Lobe& lobe : glass.lobes(side, Carried::flux)) {
                for (const double cosine : {1.0, 0.6, 0.15}) {
                    const Vec3 in = at_cosine(cosine);
                    const auto draw = [&](double u1, double u2) -> std::optional<Vec3> {
                        const auto sample = sample_brdf(lobe.scattering, in, u1, u2);
                        if (!sample) return std::nullopt;
                        return sample->direction;
                    };
                    const auto pdf = [&](const Vec3& out) { return pdf_per_sr(lobe.scattering, in, out); };
                    const DirectionGrid grid(0, {-in.x, -in.y, in.z}, 2);
                    least_p = std::min(least_p, grid.p_value(100'000, 78, draw, pdf));
                    ++compared;
                }
            }
        }
    }
    EXPECT_GT(least_p, 0.01 / compared);
}

TEST(Glazing, HasTheShapeOfItsKind) {
    Glazing::Parameters parameters;
    parameters.visible_transmittance = SharesByAngle::along_normal(Rgb::grey(0.7));
    const Glazing clear(parameters);
    EXPECT_NEAR(clear.straight_transmittance(1)[0], 0.7, 1e-12);
    // Radiance's transmissivity of that transmittance.
    EXPECT_NEAR((std::sqrt(.8402528435 + .0072522239 * .7 * .7) - .9166530661) / (.0036261119 * .7), 0.763,
                1e-3);
    EXPECT_NEAR(clear.straight_transmittance(0.5)[0],
                ThinDielectric(1.52, Rgb::grey(0.76284)).shares(0.5).transmittance[0], 1e-5);
    parameters = {};
    parameters.transmittance = SharesByAngle::along_normal(Rgb::grey(0.7));
    parameters.reflectance = SharesByAngle::along_normal(Rgb::grey(0.1));
    parameters.back_reflectance = SharesByAngle::along_normal(Rgb::grey(0.2));
    const Glazing coated(parameters);
    const double cosine = std::cos(60 * kPi / 180);
    EXPECT_NEAR(coated.straight_transmittance(1)[0], 0.7, 1e-12);
    EXPECT_NEAR(coated.straight_transmittance(cosine)[0], 0.7 * 0.8982, 1e-4);
    EXPECT_NEAR(coated.reflectance(LightSide::outside, 1)[0], 0.1, 1e-12);
    EXPECT_NEAR(coated.reflectance(LightSide::inside, 1)[0], 0.2, 1e-12);
    EXPECT_NEAR(coated.reflectance(LightSide::outside, cosine)[0], 0.1 + 0.9 * 0.0785, 1e-4);
    EXPECT_NEAR(coated.straight_transmittance(0)[0], 0, 1e-12);
    parameters = {};
    parameters.transmittance = {{{0, {{0.6, 0.7, 0.8}}}, {60, Rgb::grey(0.5)}, {90, {}}}};
    parameters.reflectance = {{{0, Rgb::grey(0.1)}, {60, Rgb::grey(0.2)}, {90, Rgb::grey(1)}}};
    const Glazing measured(parameters);
    EXPECT_FALSE(parameters.contradiction());
    EXPECT_NEAR(measured.straight_transmittance(std::cos(30 * kPi / 180))[0], 0.55, 1e-12);
    EXPECT_NEAR(measured.straight_transmittance(std::cos(75 * kPi / 180))[2], 0.25, 1e-12);
    EXPECT_NEAR(measured.reflectance(LightSide::inside, std::cos(30 * kPi / 180))[1], 0.15, 1e-12);
}

TEST(Glazing, IsBronzeUpToATransmittanceOf0645) {
    const double cosine = std::cos(60 * kPi / 180);
    for (const auto& [transmittance, shape] : {std::pair{0.644, 0.8397}, {0.645, 0.8397}, {0.646, 0.8982}}) {
        Glazing::Parameters parameters;
        parameters.transmittance = SharesByAngle::along_normal(Rgb::grey(transmittance));
        parameters.reflectance = SharesByAngle::along_normal(Rgb::grey(0.1));
        EXPECT_NEAR(Glazing(parameters).straight_transmittance(cosine)[0] / transmittance, shape, 1e-4);
    }
}

TEST(Glazing, RefusesContradictions) {
    Glazing::Parameters parameters;
    EXPECT_EQ(parameters.contradiction(),
              "visible_transmittance, or transmittance and reflectance, are missing.");
    parameters.transmittance = {{{0, Rgb::grey(0.8)}, {90, Rgb::grey(0.3)}}};
    parameters.reflectance = {{{0, Rgb::grey(0.1)}, {90, Rgb::grey(1)}}};
    EXPECT_TRUE(parameters.contradiction()->starts_with("at "));
    parameters.visible_transmittance = SharesByAngle::along_normal(Rgb::grey(0.5));
    EXPECT_TRUE(parameters.contradiction()->starts_with("visible_transmittance says all"));
}

}  // namespace
}  // namespace stilb::materials
