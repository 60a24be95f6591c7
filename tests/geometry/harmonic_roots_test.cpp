#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "math/first_root.h"
#include "support/harmonic_shapes.h"

namespace stilb::geometry {
namespace {

constexpr double kNarrowest = 1e-9;

TEST(HarmonicRoots, TheFirstOfManyIsFound) {
    const auto wave = [](double x) { return std::pair(std::sin(20 * x), 20 * std::cos(20 * x)); };
    EXPECT_NEAR(*math::first_root(wave, 400, kNarrowest, 0.01, 9, math::Sign::positive),
                3.14159265358979324 / 20, 1e-14);
    EXPECT_NEAR(*math::first_root(wave, 400, kNarrowest, 0.2, 9, math::Sign::negative),
                2 * 3.14159265358979324 / 20, 1e-14);
    EXPECT_FALSE(math::first_root(wave, 400, kNarrowest, 0.01, 0.15, math::Sign::positive));
}

TEST(HarmonicRoots, APairIsFoundWhereTheFunctionHardlyComesBelow0) {
    for (const double below : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const auto touching = [&](double x) {
            return std::pair((x - 0.3) * (x - 0.3) - below, 2 * (x - 0.3));
        };
        const auto found = math::first_root(touching, 2, kNarrowest, -4, 5, math::Sign::positive);
        ASSERT_TRUE(found) << below;
        EXPECT_NEAR(*found, 0.3 - std::sqrt(below), 1e-9) << below;
    }
    const auto passing = [](double x) { return std::pair((x - 0.3) * (x - 0.3) + 1e-12, 2 * (x - 0.3)); };
    EXPECT_FALSE(math::first_root(passing, 2, kNarrowest, -4, 5, math::Sign::positive));
}

/// Values of rounding's size have any sign over a wide part.
TEST(HarmonicRoots, AFlatCrossingInNoiseIsFound) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const double at = 0.3 + 0.1 * Numbers(seed).next();
        const auto flat = [&](double x) {
            const double beyond = x - at,
                         noise = 1e-16 * std::sin(1e12 * (1 + x) * static_cast<double>(seed + 1));
            return std::pair(beyond * beyond * beyond + noise, 3 * beyond * beyond);
        };
        const auto found = math::first_root(flat, 6 * 2, kNarrowest, -1, 1, math::Sign::negative);
        ASSERT_TRUE(found) << seed;
        EXPECT_NEAR(*found, at, 1e-5) << seed;
    }
}

}  // namespace
}  // namespace stilb::geometry
