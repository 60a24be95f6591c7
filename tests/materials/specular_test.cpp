#include <gtest/gtest.h>

#include <numbers>

#include "materials/dielectric.h"
#include "materials/material.h"
#include "materials/mirror.h"
#include "materials/thin_dielectric.h"

namespace stilb::materials {
namespace {

Vec3 arriving_at(double degrees) {
    const double theta = degrees * std::numbers::pi / 180;
    return {std::sin(theta) * std::cos(0.7), std::sin(theta) * std::sin(0.7), std::cos(theta)};
}
double cosine(double degrees) { return arriving_at(degrees).z; }

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
    for (const double degrees : kDegrees) {
        for (const LightSide side : {LightSide::outside, LightSide::inside}) {
            const Vec3 in = arriving_at(degrees);
            const double ior = side == LightSide::outside ? 1.5 : 1 / 1.5;
            const double chance = fresnel_reflectance(in.z, ior).unpolarised();
            const SpecularBranches branches = specular_branches(Dielectric{1.5}, side, in);
            ASSERT_EQ(branches.list().size(), chance < 1 ? 2u : 1u);
            const SpecularBranch& back = branches.list()[0];
            EXPECT_EQ(back.share, Rgb::grey(chance));
            EXPECT_EQ(back.luminance_factor, 1);
            EXPECT_LT(length(back.direction - reflected(in, {0, 0, 1})), 1e-15);
            if (chance == 1) continue;
            const auto& [out, share, factor] = branches.list()[1];
            EXPECT_NEAR(share[1], 1 - chance, 1e-15);
            EXPECT_NEAR(length(out), 1, 1e-14);
            EXPECT_LT(out.z, 0);
            EXPECT_NEAR(ior * std::hypot(out.x, out.y), std::hypot(in.x, in.y), 1e-12);
            EXPECT_NEAR(out.x * in.y, out.y * in.x, 1e-14);
            EXPECT_LT(out.x * in.x, 1e-300);
            EXPECT_NEAR(factor, 1 / (ior * ior), 1e-15);
        }
    }
}

TEST(GlassMaterial, LuminanceComesBackFromWithin) {
    // Back along the same way, seen in the frame of the inside, whose z points the other way.
    const Vec3 in = arriving_at(50);
    const SpecularBranches entered = specular_branches(Dielectric{1.7}, LightSide::outside, in);
    const Vec3 down = entered.list()[1].direction;
    const SpecularBranches left =
        specular_branches(Dielectric{1.7}, LightSide::inside, {down.x, down.y, -down.z});
    ASSERT_EQ(left.list().size(), 2u);
    EXPECT_LT(length(left.list()[1].direction - Vec3{in.x, in.y, -in.z}), 1e-14);
    EXPECT_NEAR(entered.list()[1].luminance_factor * left.list()[1].luminance_factor, 1, 1e-14);
    EXPECT_NEAR(entered.list()[1].share[0], left.list()[1].share[0], 1e-14);
}

TEST(PaneMaterial, HasTheTransmittancesOfWindowGlass) {
    const ThinDielectric pane{1.52, Rgb::grey(0.96)};
    EXPECT_NEAR(pane.shares(1).transmittance[1], 0.8815, 5e-5);
    EXPECT_NEAR(pane.shares(0.5).transmittance[1], 0.8015, 5e-5);
}

TEST(PaneMaterial, KeepsAllLightWhereNothingIsAbsorbedInside) {
    for (const double degrees : kDegrees) {
        for (const double ior : {1.0, 1.3, 1.52, 2.5}) {
            const ThinDielectric::Shares clear = ThinDielectric{ior, Rgb::grey(1)}.shares(cosine(degrees));
            const ThinDielectric::Shares grey =
                ThinDielectric{ior, {{0.9, 0.5, 0.1}}}.shares(cosine(degrees));
            for (std::size_t b = 0; b < kBands; ++b) {
                EXPECT_NEAR(clear.reflectance[b] + clear.transmittance[b], 1, 1e-12);
                EXPECT_LT(grey.reflectance[b] + grey.transmittance[b], 1);
                EXPECT_GE(grey.reflectance[b], 0);
            }
        }
    }
    EXPECT_EQ(ThinDielectric{}.shares(0).reflectance, Rgb::grey(1));
}

TEST(PaneMaterial, ReflectsAndLetsPassStraightOn) {
    const ThinDielectric pane{1.52, {{0.9, 0.8, 0.3}}};
    for (const double degrees : kDegrees) {
        const Vec3 in = arriving_at(degrees);
        const ThinDielectric::Shares shares = pane.shares(in.z);
        for (const LightSide side : {LightSide::outside, LightSide::inside}) {
            const SpecularBranches branches = specular_branches(pane, side, in);
            ASSERT_EQ(branches.list().size(), 2u);
            EXPECT_EQ(branches.list()[0].share, shares.reflectance);
            EXPECT_LT(length(branches.list()[0].direction - reflected(in, {0, 0, 1})), 1e-15);
            EXPECT_EQ(branches.list()[1].share, shares.transmittance);
            EXPECT_EQ(branches.list()[1].direction, -in);
            for (const SpecularBranch& branch : branches.list()) EXPECT_EQ(branch.luminance_factor, 1);
        }
    }
}

TEST(MirrorMaterial, ReflectsIntoTheMirroredDirection) {
    const Vec3 in = arriving_at(35);
    const SpecularBranches branches = specular_branches(Mirror{Rgb::grey(0.9)}, LightSide::inside, in);
    ASSERT_EQ(branches.list().size(), 1u);
    EXPECT_EQ(branches.list()[0].share, Rgb::grey(0.9));
    EXPECT_LT(length(branches.list()[0].direction - reflected(in, {0, 0, 1})), 1e-15);
    EXPECT_TRUE(specular_branches(Mirror{}, LightSide::outside, in).list().empty());
}

TEST(SpecularMaterials, ReflectNothingFromBelow) {
    for (const Material& material :
         {Material(Mirror{Rgb::grey(1)}), Material(Dielectric{}), Material(ThinDielectric{})}) {
        EXPECT_TRUE(is_specular(material));
        EXPECT_TRUE(specular_branches(material, LightSide::outside, {0, 0, -1}).list().empty());
        EXPECT_FALSE(sample_brdf(material, arriving_at(20), 0.5, 0.5)) << "has no density to draw from";
        EXPECT_EQ(evaluate_brdf_per_sr(material, arriving_at(20), arriving_at(20)), Rgb{});
    }
}

}  // namespace
}  // namespace stilb::materials
