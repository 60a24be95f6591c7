#include "materials/material.h"

#include <gtest/gtest.h>

#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "math/sampling.h"
#include "support/direction_grid.h"

namespace stilb::materials {
namespace {

/// A unit vector at this angle to the normal, at an azimuth that is no axis.
Vec3 incident_at(double degrees) {
    const double theta = degrees * kPi / 180;
    return {std::sin(theta) * std::cos(0.7), std::sin(theta) * std::sin(0.7), std::cos(theta)};
}

constexpr std::array<double, 4> kIncidenceDegrees{0, 45, 80, 89.9};
constexpr std::array<double, 4> kExponents{0, 1, 50, 1e4};

/// Bands differ, so that a band taken for another is noticed; diffuse + specular = 1 in the last one.
Phong phong(double exponent) { return {{{0.4, 0.1, 0.3}}, {{0.2, 0.6, 0.7}}, exponent}; }
Phong glossy(double exponent) { return {{}, Rgb::grey(1), exponent}; }

/// Over the hemisphere, finer around the mirrored direction where the lobe is narrow.
DirectionGrid grid_for(double exponent, const Vec3& in) {
    return {0, {-in.x, -in.y, in.z}, exponent < 10 ? 1 : exponent < 1000 ? 3 : 8};
}

/// Integral of f cos over outgoing directions, per band.
Rgb albedo(const Phong& material, const Vec3& in) {
    return grid_for(material.exponent, in).integrate_all([&](const Vec3& out) {
        return evaluate_brdf_per_sr(material, in, out) * out.z;
    });
}

double p_of_samples(const Material& material, const Vec3& in, const DirectionGrid& grid) {
    const auto draw = [&](double u1, double u2) -> std::optional<Vec3> {
        const auto sample = sample_brdf(material, in, u1, u2);
        if (!sample) return std::nullopt;
        return sample->direction;
    };
    const auto pdf = [&](const Vec3& out) { return pdf_per_sr(material, in, out); };
    return grid.p_value(200'000, 77, draw, pdf);
}

TEST(DiffuseMaterial, SamplesFollowTheirDensity) {
    const Diffuse material{{{0.2, 0.5, 0.8}}};
    for (const double degrees : kIncidenceDegrees) {
        const Vec3 in = incident_at(degrees);
        EXPECT_GT(p_of_samples(material, in, {0, {0, 0, 1}, 1}), kLeastP) << degrees;
    }
}

TEST(DiffuseMaterial, WhiteReflectsAllLight) {
    RandomPairs random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto [u1, u2] = random.next_pair();
        const auto sample = sample_brdf(Diffuse{Rgb::grey(1)}, incident_at(60), u1, u2);
        ASSERT_TRUE(sample);
        EXPECT_EQ(sample->weight, Rgb::grey(1));
    }
}

TEST(PhongMaterial, SamplesFollowTheirDensity) {
    for (const double exponent : kExponents) {
        for (const double degrees : kIncidenceDegrees) {
            const Vec3 in = incident_at(degrees);
            const DirectionGrid grid = grid_for(exponent, in);
            EXPECT_GT(p_of_samples(phong(exponent), in, grid), kLeastP) << exponent << ' ' << degrees;
            EXPECT_GT(p_of_samples(glossy(exponent), in, grid), kLeastP) << exponent << ' ' << degrees;
        }
    }
}

TEST(PhongMaterial, LobeReflectsAllLightAtNormalIncidence) {
    // (n+2)/(2 pi) times the integral of cos^(n+1) over the hemisphere, 2 pi / (n+2).
    for (const double exponent : kExponents) {
        const Phong material = phong(exponent);
        const Rgb reflected = albedo(material, {0, 0, 1});
        for (std::size_t band = 0; band < kBands; ++band) {
            EXPECT_NEAR(reflected[band], material.diffuse[band] + material.specular[band], 1e-6) << exponent;
        }
    }
}

TEST(PhongMaterial, LobeLosesTheShareBelowTheSurfaceAtGrazingIncidence) {
    // At 90 degrees the lobe is 1/2 for n = 0 and, the integral of 3/(2 pi) x+ z+ being 1/pi, 1/pi for n = 1.
    const Vec3 in = incident_at(90 - 1e-7);
    EXPECT_NEAR(albedo(glossy(0), in)[0], 0.5, 1e-3);
    EXPECT_NEAR(albedo(glossy(1), in)[0], 1 / kPi, 1e-4);
}

TEST(PhongMaterial, ReflectsNoMoreThanArrives) {
    for (const double exponent : {0.0, 0.3, 1.0, 50.0, 1e4, 1e6}) {
        for (double degrees = 0; degrees < 90; degrees += 12.8) {
            const Phong material = phong(exponent);
            const Rgb reflected = albedo(material, incident_at(degrees));
            const Rgb bound = reflectance_bound(material);
            for (std::size_t band = 0; band < kBands; ++band) {
                EXPECT_LE(reflected[band], bound[band] + 1e-5) << exponent << ' ' << degrees;
            }
            EXPECT_NEAR(bound[2], 1, 1e-15);
        }
    }
}

TEST(PhongMaterial, MeanWeightIsTheAlbedo) {
    constexpr int kSamples = 100'000;
    RandomPairs random(9);
    for (const double exponent : kExponents) {
        for (const double degrees : kIncidenceDegrees) {
            const Phong material = phong(exponent);
            const Vec3 in = incident_at(degrees);
            const Rgb exact = albedo(material, in);
            Rgb sum, squares;
            for (int i = 0; i < kSamples; ++i) {
                const auto [u1, u2] = random.next_pair();
                if (const auto sample = sample_brdf(material, in, u1, u2)) {
                    sum += sample->weight;
                    squares += sample->weight * sample->weight;
                }
            }
            for (std::size_t band = 0; band < kBands; ++band) {
                const double mean = sum[band] / kSamples;
                const double error = std::sqrt((squares[band] / kSamples - mean * mean) / kSamples);
                EXPECT_LT(std::abs(mean - exact[band]), 4 * error) << exponent << ' ' << degrees;
            }
        }
    }
}

TEST(PhongMaterial, WeightIsBrdfTimesCosineOverDensity) {
    // To the digits that cos^n keeps: n times the rounding of the cosine. The weight is bounded as the
    // mixture's lobe is (n+1)/(n+2) of the reflected one.
    RandomPairs random(10);
    for (const double exponent : {0.0, 1.0, 50.0, 1e4, 1e6}) {
        for (const double degrees : {0.0, 45.0, 80.0, 89.9, 89.999999}) {
            const Phong material = phong(exponent);
            const Vec3 in = incident_at(degrees);
            for (int i = 0; i < 1000; ++i) {
                const auto [u1, u2] = random.next_pair();
                const auto sample = sample_brdf(material, in, u1, u2);
                if (!sample) continue;
                const Vec3& out = sample->direction;
                ASSERT_GT(out.z, 0);
                ASSERT_NEAR(length(out), 1, 1e-14);
                ASSERT_GT(sample->pdf_per_sr, 0);
                ASSERT_NEAR(pdf_per_sr(material, in, out) / sample->pdf_per_sr, 1, 1e-13);
                const Rgb f = evaluate_brdf_per_sr(material, in, out);
                for (std::size_t band = 0; band < kBands; ++band) {
                    ASSERT_NEAR(sample->weight[band], f[band] * out.z / sample->pdf_per_sr,
                                1e-13 * sample->weight[band]);
                }
                const double bound =
                    reflectance_bound(material).luminance() * (exponent + 2) / (exponent + 1);
                ASSERT_LE(sample->weight.luminance(), bound * (1 + 1e-13));
            }
        }
    }
}

TEST(PhongMaterial, IsFiniteAtTheEndsOfTheRandomNumbers) {
    constexpr double kLargest = 0x1.fffffffffffffp-1;
    for (const double exponent : {0.0, 1.0, 1e6}) {
        for (const double u1 : {0.0, 0x1p-53, 0.5, kLargest}) {
            for (const double u2 : {0.0, 0.5, kLargest}) {
                const auto sample = sample_brdf(phong(exponent), incident_at(30), u1, u2);
                if (!sample) continue;
                EXPECT_TRUE(is_finite(sample->direction) && sample->weight.is_finite());
                EXPECT_GT(sample->pdf_per_sr, 0);
            }
        }
    }
}

TEST(PhongMaterial, WithoutReflectanceAbsorbs) {
    EXPECT_FALSE(sample_brdf(Phong{}, incident_at(10), 0.4, 0.5));
    EXPECT_EQ(pdf_per_sr(Phong{}, incident_at(10), incident_at(20)), 0);
}

TEST(BlackMaterial, Absorbs) {
    EXPECT_FALSE(sample_brdf(Black{}, incident_at(35), 0.2, 0.9));
    EXPECT_EQ(reflectance_bound(Black{}), Rgb{});
}

TEST(EveryMaterial, IsReciprocalAndBlackFromBelow) {
    RandomPairs random(11);
    const std::array<Material, 7> materials{
        Diffuse{{{0.2, 0.5, 0.8}}}, phong(0), phong(1), phong(50), phong(1e4),
        Mirror{Rgb::grey(0.9)},     Black{}};
    for (const Material& material : materials) {
        for (int i = 0; i < 1000; ++i) {
            const auto [u1, u2] = random.next_pair();
            const auto [u3, u4] = random.next_pair();
            const Vec3 in = math::sample_cosine_hemisphere(u1, u2).direction;
            const Vec3 out = math::sample_cosine_hemisphere(u3, u4).direction;
            const Rgb forward = evaluate_brdf_per_sr(material, in, out);
            const Rgb backward = evaluate_brdf_per_sr(material, out, in);
            for (std::size_t band = 0; band < kBands; ++band) {
                ASSERT_NEAR(forward[band], backward[band], 1e-13 * forward[band]);
            }
            ASSERT_EQ(evaluate_brdf_per_sr(material, in, -out), Rgb{});
            ASSERT_EQ(pdf_per_sr(material, in, -out), 0);
            ASSERT_FALSE(sample_brdf(material, -in, u1, u2));
        }
    }
}

TEST(EveryMaterial, KnowsItsMeanConcentration) {
    EXPECT_EQ(mean_concentration(Diffuse{Rgb::grey(0.3)}), 1);
    EXPECT_EQ(mean_concentration(Mirror{Rgb::grey(0.3)}), 0);
    EXPECT_EQ(mean_concentration(Diffuse{}), 0);
    EXPECT_EQ(mean_concentration(Black{}), 0);
    // At normal incidence: the integral of pi f / albedo over the light that is reflected.
    const Vec3 in{0, 0, 1};
    for (const double exponent : {0.0, 1.0, 20.0, 500.0}) {
        for (const double specular : {0.0, 0.1, 0.6}) {
            const Phong material{Rgb::grey(0.6 - specular), Rgb::grey(specular), exponent};
            double mean = 0;
            constexpr int steps = 200000;
            for (int i = 0; i < steps; ++i) {
                const double cosine = (i + 0.5) / steps;
                const Vec3 out{std::sqrt(1 - cosine * cosine), 0, cosine};
                const double relative = kPi * evaluate_brdf_per_sr(material, in, out)[0] / 0.6;
                mean += relative * relative * 2 * cosine / steps;
            }
            EXPECT_NEAR(mean_concentration(material), mean, 1e-4 * mean) << exponent << ' ' << specular;
        }
    }
}

TEST(EveryMaterial, KnowsWhetherItIsSpecular) {
    EXPECT_TRUE(is_specular(Mirror{}));
    EXPECT_FALSE(is_specular(phong(1e6)));
    EXPECT_FALSE(is_specular(Diffuse{}));
    EXPECT_FALSE(is_specular(Black{}));
}

}  // namespace
}  // namespace stilb::materials
