#include "math/sampling.h"

#include <gtest/gtest.h>

#include "support/direction_grid.h"

namespace stilb::math {
namespace {

constexpr Vec3 kUp{0, 0, 1};
constexpr std::size_t kSamples = 200'000;

double cosine_power_pdf(double exponent, double cos_theta) {
    return cos_theta > 0 ? (exponent + 1) / (2 * kPi) * std::pow(cos_theta, exponent) : 0;
}

/// Finer about the lobe where it is narrow.
int concentration_for(double exponent) { return exponent < 10 ? 1 : exponent < 1000 ? 3 : 8; }

/// chi2 of directions against `pdf`; each sample must carry that density, and be a unit vector.
template <typename Draw, typename Pdf>
double check_directions(const DirectionGrid& grid, Draw&& draw, Pdf&& pdf) {
    const auto checked = [&](double u1, double u2) -> std::optional<Vec3> {
        const DirectionSample sample = draw(u1, u2);
        EXPECT_NEAR(length(sample.direction), 1, 1e-14);
        EXPECT_NEAR(sample.pdf_per_sr / pdf(sample.direction), 1, 1e-6) << u1 << ' ' << u2;
        return sample.direction;
    };
    return grid.p_value(kSamples, 20240601, checked, pdf);
}

TEST(UnitDisk, IsUniformInArea) {
    constexpr std::size_t kRings = 20;
    constexpr std::size_t kSectors = 24;
    std::vector<double> observed(kRings * kSectors);
    RandomPairs random(1);
    for (std::size_t i = 0; i < kSamples; ++i) {
        const auto [u1, u2] = random.next_pair();
        const DiskPoint p = sample_unit_disk(u1, u2);
        const double r2 = p.x * p.x + p.y * p.y;
        ASSERT_LE(r2, 1 + 1e-15);
        const double turn = std::atan2(p.y, p.x) / (2 * kPi) + 0.5;
        const auto ring = std::min(static_cast<std::size_t>(r2 * kRings), kRings - 1);
        const auto sector = std::min(static_cast<std::size_t>(turn * kSectors), kSectors - 1);
        ++observed[ring * kSectors + sector];
    }
    const std::vector<double> expected(observed.size(), static_cast<double>(kSamples) / (kRings * kSectors));
    EXPECT_GT(statistics::chi2_test(observed, expected).p_value, kLeastP);
}

TEST(UnitDisk, IsContinuous) {
    // A concentric map has no cut: near numbers give near points (also across the diagonals and the centre).
    RandomPairs random(2);
    constexpr double kStep = 1e-7;
    for (int i = 0; i < 10'000; ++i) {
        const double u1 = random.next() * (1 - kStep);
        const double u2 = i % 2 ? u1 : random.next();
        const DiskPoint p = sample_unit_disk(u1, u2);
        const DiskPoint q = sample_unit_disk(u1 + kStep, u2);
        ASSERT_LT(std::hypot(p.x - q.x, p.y - q.y), 4 * kStep);
    }
    EXPECT_EQ(sample_unit_disk(0.5, 0.5).x, 0);
}

TEST(CosineHemisphere, FollowsItsDensity) {
    EXPECT_GT(check_directions(DirectionGrid(0, kUp, 1), sample_cosine_hemisphere,
                               [](const Vec3& w) { return cosine_hemisphere_pdf_per_sr(w.z); }),
              kLeastP);
    EXPECT_EQ(cosine_hemisphere_pdf_per_sr(-0.5), 0);
}

TEST(CosineHemisphere, HasDirectionsSpreadEvenly) {
    for (const std::uint32_t count : {8u, 16u, 64u}) {
        double sum_of_cosines = 0, least = 1;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec3 direction = cosine_direction(i, count);
            EXPECT_NEAR(length(direction), 1, 1e-12);
            sum_of_cosines += direction.z;
            least = std::min(least, direction.z);
        }
        EXPECT_NEAR(sum_of_cosines / count, 2. / 3, 1. / count);
        EXPECT_GT(least, 0.1 / std::sqrt(count));  // none lies in the plane
    }
}

TEST(UniformSphere, FollowsItsDensity) {
    EXPECT_GT(check_directions(DirectionGrid(-1, {1, 0, 0}, 1), sample_sphere,
                               [](const Vec3&) { return 1 / (4 * kPi); }),
              kLeastP);
}

TEST(Cone, FollowsItsDensity) {
    for (const double one_minus_cos : {1e-6, 0.01, 0.7, 1.0, 1.9, 2.0}) {
        const auto draw = [&](double u1, double u2) { return sample_cone(one_minus_cos, u1, u2); };
        const auto pdf = [&](const Vec3&) { return 1 / (2 * kPi * one_minus_cos); };
        EXPECT_GT(check_directions(DirectionGrid(1 - one_minus_cos, kUp, 1), draw, pdf), kLeastP)
            << one_minus_cos;
    }
}

TEST(Cone, KeepsItsDigitsWhereItIsNarrow) {
    // The sun's disk from a distant star. 1 - cos(theta) would round to 0; sin^2(theta) / 2 equals it here.
    constexpr double kOneMinusCos = 1e-20;
    std::vector<double> shares;
    RandomPairs random(3);
    for (int i = 0; i < 20'000; ++i) {
        const auto [u1, u2] = random.next_pair();
        const Vec3 w = sample_cone(kOneMinusCos, u1, u2).direction;
        shares.push_back((w.x * w.x + w.y * w.y) / 2 / kOneMinusCos);
    }
    EXPECT_GT(statistics::uniformity_p(shares), kLeastP);
}

TEST(CosinePower, FollowsItsDensity) {
    for (const double exponent : {0.0, 0.5, 1.0, 50.0, 1e4}) {
        const auto draw = [&](double u1, double u2) { return sample_cosine_power(exponent, u1, u2); };
        const auto pdf = [&](const Vec3& w) { return cosine_power_pdf(exponent, w.z); };
        EXPECT_GT(check_directions(DirectionGrid(0, kUp, concentration_for(exponent)), draw, pdf), kLeastP)
            << exponent;
    }
}

TEST(CosinePower, TestNoticesAWrongExponent) {
    const auto draw = [](double u1, double u2) -> std::optional<Vec3> {
        return sample_cosine_power(50, u1, u2).direction;
    };
    const auto wrong = [](const Vec3& w) { return cosine_power_pdf(51.5, w.z); };
    EXPECT_LT(DirectionGrid(0, kUp, 3).p_value(kSamples, 5, draw, wrong), kLeastP);
}

TEST(CosinePower, IsFiniteAtTheEndsOfItsRange) {
    constexpr double kLargest = 0x1.fffffffffffffp-1;
    for (const double exponent : {0.0, 1.0, 1e4, 1e6}) {
        for (const double u1 : {0.0, 0x1p-53, 0.5, kLargest}) {
            const DirectionSample sample = sample_cosine_power(exponent, u1, 0.3);
            EXPECT_NEAR(length(sample.direction), 1, 1e-14);
            EXPECT_GT(sample.pdf_per_sr, 0);
            EXPECT_TRUE(std::isfinite(sample.pdf_per_sr));
        }
    }
}

TEST(TriangleSampling, IsUniformInArea) {
    // (b1, b2) uniform in area: the chance of b1 + b2 <= t is t^2, and b1 / (b1 + b2) is uniform and
    // independent.
    constexpr std::size_t kSide = 20;
    std::vector<double> observed(kSide * kSide);
    RandomPairs random(4);
    for (std::size_t i = 0; i < kSamples; ++i) {
        const auto [u1, u2] = random.next_pair();
        const Barycentric b = sample_triangle(u1, u2);
        ASSERT_NEAR(b.b0 + b.b1 + b.b2, 1, 1e-15);
        ASSERT_GE(std::min({b.b0, b.b1, b.b2}), 0);
        const double sum = b.b1 + b.b2;
        const auto row = std::min(static_cast<std::size_t>(sum * sum * kSide), kSide - 1);
        const auto column = std::min(static_cast<std::size_t>(b.b1 / sum * kSide), kSide - 1);
        ++observed[row * kSide + column];
    }
    const std::vector<double> expected(observed.size(), static_cast<double>(kSamples) / (kSide * kSide));
    EXPECT_GT(statistics::chi2_test(observed, expected).p_value, kLeastP);
}

}  // namespace
}  // namespace stilb::math
