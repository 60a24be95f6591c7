#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/harmonics/surface.h"
#include "stilb/error.h"
#include "support/harmonic_shapes.h"

namespace stilb::geometry {
namespace {

HarmonicSurface unit_sphere() {
    return HarmonicSurface(math::HarmonicSeries<double>(std::vector{kUnitSphere}));
}

/// How far a point is outside, in terms of its distance from the origin.
double excess(const HarmonicSurface& surface, const Vec3& point) {
    return length(point) - surface.radius().at(normalized(point));
}

/// The first change of side along a ray, by many small steps and halving.
std::optional<double> march(const HarmonicSurface& surface, const Vec3& origin, const Vec3& direction) {
    constexpr int steps = 6000;
    const double closest = -dot(origin, direction), reach = 1.2 * surface.greatest_radius();
    double from = std::max(0.0, closest - reach);
    const double length = closest + reach - from;
    if (length <= 0) return std::nullopt;
    const bool starts_outside = excess(surface, origin + from * direction) > 0;
    for (int i = 0; i < steps; ++i, from += length / steps) {
        double low = from, high = from + length / steps;
        if ((excess(surface, origin + high * direction) > 0) == starts_outside) continue;
        while (high - low > 1e-12) {
            const double middle = 0.5 * (low + high);
            ((excess(surface, origin + middle * direction) > 0) == starts_outside ? low : high) = middle;
        }
        return low;
    }
    return std::nullopt;
}

TEST(HarmonicSurface, OfDegree0IsASphere) {
    const HarmonicSurface sphere = unit_sphere();
    Numbers numbers(1);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 origin = (i % 2 == 0 ? 3 : 0.9) * numbers.next() * numbers.direction();
        const Vec3 direction = numbers.direction();
        const double closest = -dot(origin, direction);
        const double squared = 1 - squared_length(origin + closest * direction);
        const auto found = sphere.first_crossing(origin, direction, 0, kInfinity);
        const double entry = closest - std::sqrt(std::max(0.0, squared));
        const double exit = closest + std::sqrt(std::max(0.0, squared));
        ASSERT_EQ(found.has_value(), squared > 0 && exit > 0);
        if (!found) continue;
        EXPECT_EQ(found->is_entered, entry > 0);
        EXPECT_NEAR(found->distance, entry > 0 ? entry : exit, 1e-12);
        EXPECT_NEAR(length(sphere.normal_at(found->direction) - found->direction), 0, 1e-15);
    }
}

TEST(HarmonicSurface, IsCrossedOnRaysThroughTheOrigin) {
    const HarmonicSurface surface = rough_surface(16, 3);
    Numbers numbers(2);
    for (const double aside : {0.0, 1e-300, 1e-15, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2}) {
        const Vec3 direction = numbers.direction();
        const Vec3 origin = -3 * direction + aside * Frame::around(direction).v;
        const auto entry = surface.first_crossing(origin, direction, 0, kInfinity);
        ASSERT_TRUE(entry && entry->is_entered) << aside;
        EXPECT_NEAR(excess(surface, origin + entry->distance * direction), 0, 1e-13) << aside;
        const auto exit = surface.first_crossing(origin, direction, 3, kInfinity);
        ASSERT_TRUE(exit && !exit->is_entered) << aside;
        EXPECT_NEAR(excess(surface, origin + exit->distance * direction), 0, 1e-13) << aside;
    }
}

/// Hits, near misses, grazing rays and rays from inside.
TEST(HarmonicSurface, IsFirstCrossedWhereMarchingSays) {
    for (const int degree : {1, 4, 16, 40}) {
        const HarmonicSurface surface = rough_surface(degree, static_cast<std::uint64_t>(degree));
        Numbers numbers(9);
        int hits = 0;
        for (int i = 0; i < 120; ++i) {
            const bool is_inside = i % 4 == 0;
            const Vec3 origin = is_inside ? 0.5 * numbers.direction() : 3 * numbers.direction();
            const Vec3 target = (1.3 * numbers.next()) * numbers.direction();
            const Vec3 direction = normalized(target - origin);
            const auto found = surface.first_crossing(origin, direction, 0, kInfinity);
            const auto expected = march(surface, origin, direction);
            ASSERT_TRUE(found || !expected) << degree << ' ' << i;
            if (!found) continue;
            ++hits;
            EXPECT_EQ(found->is_entered, !is_inside);
            // Marching may step over two crossings.
            if (expected) {
                EXPECT_LT(found->distance, *expected + 1e-9) << degree << ' ' << i;
            }
            const auto at = [&](double beyond) {
                return excess(surface, origin + (found->distance + beyond) * direction);
            };
            EXPECT_NEAR(at(0), 0, 1e-11) << degree << ' ' << i;
            if (!expected || found->distance < *expected - 1e-9) {
                EXPECT_LT(at(1e-8) * at(-1e-8), 0) << degree << ' ' << i;
            }
        }
        EXPECT_GT(hits, 60) << degree;
    }
}

TEST(HarmonicSurface, IsCrossedBetweenStartAndEndOnly) {
    const HarmonicSurface sphere = unit_sphere();
    const Vec3 origin{-3, 0.2, 0}, along{1, 0, 0};
    const double half = std::sqrt(1 - 0.04);
    EXPECT_FALSE(sphere.first_crossing(origin, along, 0, 3 - half - 1e-6));
    EXPECT_TRUE(sphere.first_crossing(origin, along, 0, 3 - half + 1e-6));
    EXPECT_NEAR(sphere.first_crossing(origin, along, 3 - half + 1e-6, 10)->distance, 3 + half, 1e-12);
    EXPECT_FALSE(sphere.first_crossing(origin, along, 3 + half + 1e-6, 10));
}

/// Against differences of points on the surface.
TEST(HarmonicSurface, HasExactNormals) {
    const HarmonicSurface surface = rough_surface(12, 5);
    Numbers numbers(4);
    const auto point = [&](const Vec3& d) { return surface.radius().at(d) * d; };
    for (int i = 0; i < 100; ++i) {
        const Vec3 direction = numbers.direction();
        const Frame frame = Frame::around(direction);
        const auto moved = [&](const Vec3& along, double angle) {
            return point(std::cos(angle) * direction + std::sin(angle) * along);
        };
        const double step = 1e-5;
        const Vec3 expected = normalized(cross(moved(frame.u, step) - moved(frame.u, -step),
                                               moved(frame.v, step) - moved(frame.v, -step)));
        EXPECT_NEAR(length(surface.normal_at(direction) - expected), 0, 1e-7);
    }
}

TEST(HarmonicSurface, HasSafeBounds) {
    for (const int degree : {0, 1, 7, 40}) {
        const HarmonicSurface surface = rough_surface(degree, 8);
        double least = kInfinity, greatest = 0;
        Numbers numbers(6);
        for (int i = 0; i < 20'000; ++i) {
            const double radius = surface.radius().at(numbers.direction());
            least = std::min(least, radius);
            greatest = std::max(greatest, radius);
        }
        EXPECT_LE(surface.least_radius(), least);
        EXPECT_GE(surface.greatest_radius(), greatest);
        EXPECT_LT(surface.greatest_radius(), 1.05 * greatest);
        EXPECT_GT(surface.least_radius(), least - 0.06 * greatest);
    }
}

TEST(HarmonicSurface, RefusesARadiusThatComesTo0) {
    EXPECT_THROW(HarmonicSurface(math::HarmonicSeries<double>(std::vector{kUnitSphere, 0., 3.5, 0.})),
                 InputError);
}

}  // namespace
}  // namespace stilb::geometry
