// Rays for which something degenerates, by roots and by cells.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/harmonics/cells.h"
#include "support/harmonic_shapes.h"

namespace stilb::geometry {
namespace {

struct Both {
    HarmonicSurface surface;
    HarmonicCells cells{surface};

    std::optional<double> by_roots(const Vec3& origin, const Vec3& direction, double start = 0) const {
        const auto found = surface.first_crossing(origin, direction, start, kInfinity);
        return found ? std::optional(found->distance) : std::nullopt;
    }
    std::optional<double> by_cells(const Vec3& origin, const Vec3& direction, double start = 0) const {
        std::optional<double> first;
        for (std::size_t cell = 0; cell < cells.count(); ++cell) {
            const double found = cells.crossing(cell, origin, direction, start, first.value_or(kInfinity));
            if (found < kInfinity) first = found;
        }
        return first;
    }
    /// Both find a distance, cells with an error along the normal.
    void expect(const Vec3& origin, const Vec3& direction, double distance, double start = 0) const {
        const auto roots = by_roots(origin, direction, start),
                   polynomial = by_cells(origin, direction, start);
        ASSERT_TRUE(roots && polynomial);
        const double slant =
            std::abs(dot(surface.normal_at(normalized(origin + *roots * direction)), direction));
        EXPECT_NEAR(*roots, distance, 1e-11 / slant);
        EXPECT_NEAR(*polynomial, distance, 2e-7 / slant);
    }
    void expect_nothing(const Vec3& origin, const Vec3& direction, double start = 0) const {
        EXPECT_FALSE(by_roots(origin, direction, start));
        EXPECT_FALSE(by_cells(origin, direction, start));
    }
};

/// Half axes of an ellipsoid whose series has converged to rounding at degree 30.
constexpr Vec3 kAxes{1, 1.2, 0.9};
constexpr Vec3 divided(const Vec3& x) { return {x.x / kAxes.x, x.y / kAxes.y, x.z / kAxes.z}; }

Both ellipsoid() { return {ellipsoid_surface(kAxes, 30)}; }

/// Where a ray meets the ellipsoid: 0 or 2 distances.
std::vector<double> ellipsoid_crossings(const Vec3& origin, const Vec3& direction) {
    const Vec3 o = divided(origin), d = divided(direction);
    const double a = squared_length(d), b = dot(o, d), c = squared_length(o) - 1, squared = b * b - a * c;
    if (squared < 0) return {};
    return {(-b - std::sqrt(squared)) / a, (-b + std::sqrt(squared)) / a};
}

TEST(HarmonicSpecialRays, MeetAnEllipsoidWhereItIs) {
    const Both both = ellipsoid();
    Numbers numbers(1);
    for (int i = 0; i < 400; ++i) {
        const Vec3 target = 1.2 * numbers.next() * numbers.direction();
        const Vec3 direction = numbers.direction(), origin = target - 3 * direction;
        const auto exact = ellipsoid_crossings(origin, direction);
        if (exact.empty()) {
            both.expect_nothing(origin, direction);
            continue;
        }
        both.expect(origin, direction, exact[0]);
        both.expect(origin, direction, exact[1], 0.5 * (exact[0] + exact[1]));
        both.expect_nothing(origin, direction, exact[1] + 1e-5);
    }
}

TEST(HarmonicSpecialRays, TouchAnEllipsoidFromJustInsideOnly) {
    const Both both = ellipsoid();
    Numbers numbers(2);
    for (int i = 0; i < 100; ++i) {
        const Vec3 outwards = numbers.direction(), touch = outwards / length(divided(outwards));
        const Vec3 normal = normalized(divided(divided(touch)));
        const Vec3 direction = normalized(cross(normal, numbers.direction()));
        both.expect_nothing(touch + 1e-6 * normal - 3 * direction, direction);
        const Vec3 origin = touch - 1e-6 * normal - 3 * direction;
        both.expect(origin, direction, ellipsoid_crossings(origin, direction)[0]);
    }
}

TEST(HarmonicSpecialRays, LeaveAnEllipsoidOnWhichTheyStart) {
    const Both both = ellipsoid();
    Numbers numbers(3);
    for (int i = 0; i < 100; ++i) {
        const Vec3 outwards = numbers.direction(), on = outwards / length(divided(outwards));
        const Vec3 normal = normalized(divided(divided(on)));
        const Vec3 direction = normalized(normal + 0.9 * numbers.direction());
        both.expect_nothing(on, direction, 1e-5);
        both.expect(on, -direction, ellipsoid_crossings(on, -direction)[1], 1e-5);
    }
}

TEST(HarmonicSpecialRays, MeetASphereOfDegree0) {
    const Both both{rough_surface(0, 1)};
    Numbers numbers(4);
    for (int i = 0; i < 400; ++i) {
        const Vec3 across = numbers.direction(), direction = Frame::around(across).u;
        const double aside = 1.1 * numbers.next();
        const Vec3 origin = aside * across - 2 * direction;
        if (aside > 1) {
            both.expect_nothing(origin, direction);
        } else {
            both.expect(origin, direction, 2 - std::sqrt(1 - aside * aside));
            both.expect(origin, direction, 2 + std::sqrt(1 - aside * aside), 2);
        }
    }
}

TEST(HarmonicSpecialRays, GoThroughTheCentre) {
    const Both both{strong_surface(12, 1, 0.2, 5)};
    Numbers numbers(5);
    const auto radius = [&](const Vec3& d) { return both.surface.radius().at(d); };
    std::vector<Vec3> directions{
        {1, 0, 0}, {0, -1, 0}, {0, 0, 1}, normalized({1, 1, 1}), normalized({1, -1, 0})};
    for (int i = 0; i < 50; ++i) directions.push_back(numbers.direction());
    for (const Vec3& direction : directions) {
        both.expect(Vec3{}, direction, radius(direction));
        both.expect_nothing(Vec3{}, direction, radius(direction) + 1e-5);
        both.expect(-4 * direction, direction, 4 - radius(-direction));
        both.expect(-4 * direction, direction, 4 + radius(direction), 4);
    }
}

/// Along the harmonics' own axis, and beside it by any amount.
TEST(HarmonicSpecialRays, GoAlongThePoles) {
    const Both both{strong_surface(12, 1, 0.2, 6)};
    for (const double aside : {0.0, 1e-300, 1e-17, 1e-15, 1e-13}) {
        for (const double sign : {-1.0, 1.0}) {
            const Vec3 direction{0, 0, sign}, origin{aside, -aside, -4 * sign};
            both.expect(origin, direction, 4 - both.surface.radius().at(-direction));
            both.expect(origin, direction, 4 + both.surface.radius().at(direction), 4);
            both.expect({aside, aside, 0}, direction, both.surface.radius().at(direction));
        }
    }
    // Across the axis, through the pole's point from the side.
    for (const double sign : {-1.0, 1.0}) {
        const Vec3 pole{0, 0, sign * 0.999 * both.surface.radius().at({0, 0, sign})};
        for (const Vec3 direction : {Vec3{1, 0, 0}, {0, -1, 0}, normalized({1, 2, 0})}) {
            const auto roots = both.by_roots(pole, direction), polynomial = both.by_cells(pole, direction);
            ASSERT_TRUE(roots && polynomial);
            both.expect(pole, direction, *roots);
            const Vec3 found = pole + *roots * direction;
            EXPECT_NEAR(length(found), both.surface.radius().at(normalized(found)), 1e-13);
        }
    }
}

}  // namespace
}  // namespace stilb::geometry
