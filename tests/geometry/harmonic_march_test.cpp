#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/harmonics/surface.h"
#include "support/harmonic_shapes.h"

namespace stilb::geometry {
namespace {

TEST(HarmonicMarch, FindsWhatRootsFindOnASmoothSurface) {
    const HarmonicSurface surface = head_like_surface(6, 1);
    const double step = kMarchedShare * surface.greatest_radius();
    Numbers numbers(2);
    for (int i = 0; i < 300; ++i) {
        const Vec3 origin = (i % 3 == 0 ? 0.3 : 3.) * numbers.direction();
        const Vec3 direction = normalized(0.4 * numbers.direction() - origin);
        const auto expected = surface.first_crossing(origin, direction, 0, kInfinity);
        const auto found = march_crossing(surface, origin, direction, 0, kInfinity, step);
        ASSERT_TRUE(found && expected) << i;
        EXPECT_NEAR(found->distance, expected->distance, 1e-13) << i;
        EXPECT_NEAR(length(found->direction - expected->direction), 0, 1e-13) << i;
        EXPECT_EQ(found->is_entered, expected->is_entered) << i;
    }
}

TEST(HarmonicMarch, StepsOverWhatIsThinner) {
    const HarmonicSurface sphere = rough_surface(0, 1);
    const Vec3 origin{-3, 1 - 1e-6, 0}, along{1, 0, 0};
    EXPECT_TRUE(sphere.first_crossing(origin, along, 0, kInfinity));
    EXPECT_FALSE(march_crossing(sphere, origin, along, 0, kInfinity, 0.02));
    EXPECT_TRUE(march_crossing(sphere, origin, along, 0, kInfinity, 0.0005));
}

TEST(HarmonicMarch, KeepsToStartAndEnd) {
    const HarmonicSurface sphere = rough_surface(0, 1);
    const Vec3 origin{-3, 0, 0}, along{1, 0, 0};
    EXPECT_FALSE(march_crossing(sphere, origin, along, 0, 2 - 1e-9, 0.02));
    EXPECT_NEAR(march_crossing(sphere, origin, along, 2 + 1e-9, 5, 0.02)->distance, 4, 1e-13);
    EXPECT_FALSE(march_crossing(sphere, origin, along, 4 + 1e-9, 5, 0.02));
    EXPECT_FALSE(march_crossing(sphere, {-3, 2, 0}, along, 0, 5, 0.02));
    EXPECT_NEAR(march_crossing(sphere, Vec3{}, along, 0, 5, 0.02)->distance, 1, 1e-13);
}

}  // namespace
}  // namespace stilb::geometry
