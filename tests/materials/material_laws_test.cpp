// The laws that every material keeps, over directions and parameters to their ends: samples follow their
// density, weights are f cos / pdf, reflection is reciprocal and no larger than what arrives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/material.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/ward.h"
#include "math/sampling.h"
#include "support/direction_grid.h"

namespace stilb::materials {
namespace {

/// Chance that a sound set of samplers fails the test of all of them, when its seeds are first used.
constexpr double kFamilyError = 0.01;

struct Case {
    std::string name;
    Material material;
    int concentration = 1;  ///< of the grid of directions: higher for narrow lobes
    bool white = false;     ///< reflects all light, from every direction
};

/// Bands differ, so that a band taken for another is noticed.
const Rgb kColour{{0.4, 0.1, 0.9}};
const Rgb kWhite = Rgb::grey(1);

int concentration_for(double width) { return width < 0.002 ? 12 : width < 0.02 ? 8 : width < 0.2 ? 4 : 2; }

std::vector<Case> make_cases() {
    std::vector<Case> cases{{"diffuse", Diffuse{kColour}},
                            {"white diffuse", Diffuse{kWhite}, 1, true},
                            {"black", Black{}},
                            {"phong 1", Phong{kColour * 0.4, kColour * 0.6, 1}},
                            {"phong 10000", Phong{kColour * 0.4, kColour * 0.6, 1e4}, 8}};
    for (const double roughness : {0.001, 0.01, 0.1, 0.3, 0.6, 1.0}) {
        const std::string name = "rough " + std::to_string(roughness);
        cases.push_back({name, RoughConductor({kColour, roughness}), concentration_for(roughness)});
        cases.push_back(
            {"white " + name, RoughConductor({kWhite, roughness}), concentration_for(roughness), true});
    }
    for (const double roughness : {0.001, 0.1, 1.0}) {
        const std::string name = "ward " + std::to_string(roughness);
        cases.push_back({name, Ward({kColour * 0.3, kColour * 0.7, {roughness, roughness}, 0}),
                         concentration_for(roughness)});
        cases.push_back({"specular " + name, Ward({{}, kWhite, {roughness, roughness}, 0}),
                         concentration_for(roughness)});
    }
    cases.push_back({"brushed ward", Ward({kColour * 0.3, kColour * 0.7, {0.1, 0.4}, 30}), 3});
    cases.push_back({"long ward", Ward({{}, kWhite, {1, 0.2}, -70}), 2});
    for (const double roughness : {0.001, 0.1, 0.4, 1.0}) {
        for (const double ior : {1.0, 1.5, 2.5}) {
            const std::string name = fmt::format("plastic {} {}", ior, roughness);
            cases.push_back({name, Plastic({kColour, ior, roughness}), concentration_for(roughness)});
            cases.push_back(
                {"white " + name, Plastic({kWhite, ior, roughness}), concentration_for(roughness), true});
        }
    }
    cases.push_back({"coat over black", Plastic({{}, 1.5, 0.3}), 2});
    return cases;
}

const std::vector<Case>& all_cases() {
    static const std::vector<Case> cases = make_cases();
    return cases;
}

/// A unit vector at this angle to the normal, at an azimuth that is no axis.
Vec3 incident(double degrees) {
    const double theta = degrees * kPi / 180;
    return {std::sin(theta) * std::cos(0.7), std::sin(theta) * std::sin(0.7), std::cos(theta)};
}

DirectionGrid grid_for(const Case& of, const Vec3& in) { return {0, {-in.x, -in.y, in.z}, of.concentration}; }

/// Integral of f cos over outgoing directions.
Rgb albedo(const Case& of, const Vec3& in) {
    return grid_for(of, in).integrate_all(
        [&](const Vec3& out) { return evaluate_brdf_per_sr(of.material, in, out) * out.z; });
}

TEST(MaterialLaws, SamplesFollowTheirDensity) {
    constexpr std::array<double, 4> degrees{0, 45, 80, 89.9};
    const double comparisons = static_cast<double>(all_cases().size() * degrees.size());
    const double least_p = -std::expm1(std::log1p(-kFamilyError) / comparisons);
    double worst = 1;
    for (const Case& of : all_cases()) {
        for (const double angle : degrees) {
            const Vec3 in = incident(angle);
            const auto draw = [&](double u1, double u2) -> std::optional<Vec3> {
                const auto sample = sample_brdf(of.material, in, u1, u2);
                if (!sample) return std::nullopt;
                return sample->direction;
            };
            const auto pdf = [&](const Vec3& out) { return pdf_per_sr(of.material, in, out); };
            const double p = grid_for(of, in).p_value(200'000, 77, draw, pdf);
            EXPECT_GT(p, least_p) << of.name << ' ' << angle;
            worst = std::min(worst, p);
        }
    }
    RecordProperty("worst_p", std::to_string(worst));
}

TEST(MaterialLaws, WeightsAreBrdfTimesCosineOverDensityAndBounded) {
    RandomPairs random(10);
    for (const Case& of : all_cases()) {
        for (const double angle : {0.0, 45.0, 80.0, 89.9, 89.999999, 90 - 1e-10}) {
            const Vec3 in = incident(angle);
            for (int i = 0; i < 2000; ++i) {
                const auto [u1, u2] = random.next_pair();
                const auto sample = sample_brdf(of.material, in, u1, u2);
                if (!sample) continue;
                const Vec3& out = sample->direction;
                ASSERT_TRUE(is_finite(out) && sample->weight.is_finite()) << of.name << ' ' << angle;
                ASSERT_GT(out.z, 0);
                ASSERT_NEAR(length(out), 1, 1e-14);
                ASSERT_GT(sample->pdf_per_sr, 0);
                ASSERT_NEAR(pdf_per_sr(of.material, in, out) / sample->pdf_per_sr, 1, 1e-12);
                const Rgb f = evaluate_brdf_per_sr(of.material, in, out);
                for (std::size_t b = 0; b < kBands; ++b) {
                    ASSERT_NEAR(sample->weight[b], f[b] * out.z / sample->pdf_per_sr,
                                1e-12 * sample->weight[b]);
                }
                // Plastic's are the largest: the coat at grazing angles, over the mean chance of drawing it.
                const double bound = of.material.is<Plastic>() ? 10 : 3;
                ASSERT_LE(sample->weight.luminance(), bound) << of.name << ' ' << angle;
            }
        }
    }
}

TEST(MaterialLaws, ReflectionIsReciprocalAndAboveTheSurface) {
    RandomPairs random(11);
    for (const Case& of : all_cases()) {
        for (int i = 0; i < 2000; ++i) {
            const auto [u1, u2] = random.next_pair();
            const auto [u3, u4] = random.next_pair();
            const Vec3 in = i % 2 == 0 ? math::sample_cosine_hemisphere(u1, u2).direction
                                       : incident(90 - 10 * std::pow(u1, 8));
            Vec3 out = math::sample_cosine_hemisphere(u3, u4).direction;
            if (i % 3 == 0) {
                const auto sample = sample_brdf(of.material, in, u3, u4);
                if (sample) out = sample->direction;
            }
            const Rgb forward = evaluate_brdf_per_sr(of.material, in, out);
            const Rgb backward = evaluate_brdf_per_sr(of.material, out, in);
            for (std::size_t b = 0; b < kBands; ++b) {
                ASSERT_GE(forward[b], 0);
                ASSERT_NEAR(forward[b], backward[b], 1e-10 * forward[b]) << of.name;
            }
            ASSERT_EQ(evaluate_brdf_per_sr(of.material, in, -out), Rgb{});
            ASSERT_EQ(pdf_per_sr(of.material, in, -out), 0);
            ASSERT_FALSE(sample_brdf(of.material, -in, u1, u2));
        }
    }
}

TEST(MaterialLaws, NoMoreIsReflectedThanArrives) {
    double least_of_white = 1, most = 0;
    for (const Case& of : all_cases()) {
        const Rgb bound = reflectance_bound(of.material);
        EXPECT_LE(bound.max(), 1 + 1e-12);
        const bool coated = of.material.is<Plastic>();
        for (const double angle : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9, 89.99}) {
            const Rgb reflected = albedo(of, incident(angle));
            for (std::size_t b = 0; b < kBands; ++b) {
                EXPECT_LE(reflected[b], (coated ? 1 : bound[b]) + 1e-3) << of.name << ' ' << angle;
            }
            most = std::max(most, reflected.max());
            if (!of.white) continue;
            least_of_white = std::min(least_of_white, reflected.min());
            EXPECT_GT(reflected.min(), 0.997) << of.name << ' ' << angle;
        }
    }
    RecordProperty("least_of_white", std::to_string(least_of_white));
    RecordProperty("most", std::to_string(most));
}

TEST(MaterialLaws, TheMeanWeightIsTheAlbedo) {
    constexpr int kSamples = 50'000;
    RandomPairs random(9);
    for (const Case& of : all_cases()) {
        for (const double angle : {0.0, 45.0, 80.0, 89.0}) {
            const Vec3 in = incident(angle);
            const double exact = albedo(of, in)[0];
            double sum = 0, squares = 0;
            for (int i = 0; i < kSamples; ++i) {
                const auto [u1, u2] = random.next_pair();
                const auto sample = sample_brdf(of.material, in, u1, u2);
                const double weight = sample ? sample->weight[0] : 0;
                sum += weight;
                squares += weight * weight;
            }
            const double mean = sum / kSamples;
            const double error = std::sqrt(std::max(0.0, squares / kSamples - mean * mean) / kSamples);
            constexpr double quadrature = 2e-4;
            EXPECT_NEAR(mean, exact, 5 * error + quadrature) << of.name << ' ' << angle;
        }
    }
}

TEST(MaterialLaws, RandomNumbersMayBeAtTheirEnds) {
    constexpr double kLargest = 0x1.fffffffffffffp-1;
    for (const Case& of : all_cases()) {
        for (const double u1 : {0.0, 0x1p-53, 0.5, kLargest}) {
            for (const double u2 : {0.0, 0.5, kLargest}) {
                for (const double angle : {0.0, 30.0, 89.9999}) {
                    const auto sample = sample_brdf(of.material, incident(angle), u1, u2);
                    if (!sample) continue;
                    EXPECT_TRUE(is_finite(sample->direction) && sample->weight.is_finite()) << of.name;
                    EXPECT_GT(sample->pdf_per_sr, 0);
                }
            }
        }
    }
}

TEST(MaterialLaws, ConcentrationIsThatOfNormalIncidence) {
    const Vec3 in{0, 0, 1};
    for (const Case& of : all_cases()) {
        const double reflected = albedo(of, in).luminance();
        if (reflected == 0) continue;
        const double mean = grid_for(of, in).integrate_all([&](const Vec3& out) {
            const double f = evaluate_brdf_per_sr(of.material, in, out).luminance() / reflected;
            return kPi * f * f * out.z;
        });
        EXPECT_NEAR(mean_concentration(of.material), mean, 0.05 * mean) << of.name;
    }
}

TEST(WardMaterial, TurnsItsGroovesCounterclockwise) {
    // Smooth along u, turned by 30 degrees: under light along the normal the highlight is long across that.
    const Ward brushed({{}, kWhite, {0.05, 0.4}, 30});
    const auto along = [&](double azimuth_deg) {
        const double phi = azimuth_deg * kPi / 180;
        const Vec3 out{std::sin(0.3) * std::cos(phi), std::sin(0.3) * std::sin(phi), std::cos(0.3)};
        return brushed.brdf_per_sr({0, 0, 1}, out)[0];
    };
    for (const double azimuth : {30.0, 210.0, 75.0, 165.0}) EXPECT_LT(along(azimuth), along(120));
    EXPECT_LT(along(30), 0.01 * along(120));
    EXPECT_NEAR(along(120), along(300), 1e-12 * along(120));
}

TEST(WardMaterial, HasThePublishedValueAtThePeak) {
    // At the mirrored direction h is along the normal: specular / (4 pi a b cos^2).
    const Vec3 in = incident(60), out{-in.x, -in.y, in.z};
    EXPECT_NEAR(Ward({{}, kWhite, {0.1, 0.2}, 17}).brdf_per_sr(in, out)[0], 1 / (4 * kPi * 0.1 * 0.2 * 0.25),
                1e-9);
}

TEST(PlasticMaterial, HasFresnelsReflectanceWhereSmooth) {
    // The albedo of the coat alone, over a black base.
    for (const double angle : {0.0, 45.0, 70.0, 80.0}) {
        const Vec3 in = incident(angle);
        const Case coat{"", Plastic({{}, 1.5, 0.001}), 8};
        EXPECT_NEAR(albedo(coat, in)[0], fresnel_reflectance(in.z, 1.5).unpolarised(), 2e-4) << angle;
    }
}

TEST(PlasticMaterial, ReflectsLessThanItsBaseByInternalReflection) {
    // 0.0918: the mean of Fresnel's reflectance of ior 1.5 under light from everywhere [Duntley 1942].
    const double outside = 0.0918, inside = 1 - (1 - outside) / 2.25;
    const double expected = outside + (1 - outside) * 0.5 * (1 - inside) / (1 - 0.5 * inside);
    EXPECT_NEAR(Plastic({Rgb::grey(0.5), 1.5, 0.001}).mean_reflectance()[0], expected, 2e-4);
}

}  // namespace
}  // namespace stilb::materials
