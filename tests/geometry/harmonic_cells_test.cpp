#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/harmonics/cells.h"
#include "support/harmonic_shapes.h"

namespace stilb::geometry {
namespace {

std::optional<double> first_of_all(const HarmonicCells& cells, const Vec3& origin, const Vec3& direction) {
    std::optional<double> first;
    for (std::size_t i = 0; i < cells.count(); ++i) {
        const double found = cells.crossing(i, origin, direction, 0, first.value_or(kInfinity));
        if (found < kInfinity) first = found;
    }
    return first;
}

/// Rays from outside and inside, aimed at the surface's surroundings.
TEST(HarmonicCells, AreCrossedWhereTheSurfaceIs) {
    for (const int degree : {0, 3, 12, 24}) {
        const HarmonicSurface surface = rough_surface(degree, 1);
        const HarmonicCells cells(surface);
        EXPECT_LE(cells.error(), 1e-7);
        Numbers numbers(5);
        for (int i = 0; i < 1500; ++i) {
            const Vec3 origin = (i % 4 == 0 ? 0.5 * numbers.next() : 3.) * numbers.direction();
            const Vec3 direction = normalized((1.3 * numbers.next()) * numbers.direction() - origin);
            const auto found = first_of_all(cells, origin, direction);
            const auto expected = surface.first_crossing(origin, direction, 0, kInfinity);
            ASSERT_EQ(found.has_value(), expected.has_value()) << degree << ' ' << i;
            if (!found) continue;
            const Vec3 normal = surface.normal_at(expected->direction);
            const double allowed = 5e-7 / std::abs(dot(normal, direction));
            EXPECT_NEAR(*found, expected->distance, allowed) << degree << ' ' << i;
        }
    }
}

TEST(HarmonicCells, LieWithinTheirBounds) {
    const HarmonicSurface surface = rough_surface(12, 1);
    const HarmonicCells cells(surface);
    Numbers numbers(6);
    for (int i = 0; i < 500; ++i) {
        const Vec3 direction = numbers.direction();
        const Vec3 point = surface.radius().at(direction) * direction;
        bool is_in_one = false;
        for (std::size_t cell = 0; cell < cells.count(); ++cell) {
            if (cells.crossing(cell, Vec3{}, direction, 0, kInfinity) == kInfinity) continue;
            const Bounds bounds = cells.bounds_of(cell);
            is_in_one = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                EXPECT_GE(point[axis], bounds.min[axis] - 1e-6);
                EXPECT_LE(point[axis], bounds.max[axis] + 1e-6);
            }
        }
        EXPECT_TRUE(is_in_one) << i;
    }
}

/// A cell in which a ray from the origin leaves the surface.
std::size_t cell_of(const HarmonicCells& cells, const Vec3& direction) {
    std::size_t cell = 0;
    while (cell + 1 < cells.count() && cells.crossing(cell, Vec3{}, direction, 0, kInfinity) == kInfinity)
        ++cell;
    return cell;
}

TEST(HarmonicCells, HaveTheSurfacesPointsAndNormals) {
    for (const int degree : {0, 5, 24}) {
        const HarmonicSurface surface = rough_surface(degree, 2);
        const HarmonicCells cells(surface);
        Numbers numbers(7);
        for (int i = 0; i < 500; ++i) {
            const Vec3 direction = numbers.direction();
            const Vec3 point = surface.radius().at(direction) * direction;
            const auto place = cells.point_at(cell_of(cells, direction), (1 + 1e-4 * numbers.next()) * point);
            EXPECT_NEAR(length(place.position - point), 0, 2e-7) << degree;
            EXPECT_NEAR(length(place.normal - surface.normal_at(direction)), 0, 1e-5) << degree;
        }
    }
}

TEST(HarmonicCells, TakeDirectionsOfAnyLength) {
    const HarmonicCells cells(rough_surface(5, 2));
    Numbers numbers(8);
    for (int i = 0; i < 100; ++i) {
        const Vec3 origin = 3 * numbers.direction();
        const Vec3 direction = normalized(0.5 * numbers.direction() - origin);
        const auto expected = first_of_all(cells, origin, direction);
        ASSERT_TRUE(expected);
        for (const double length : {1e-3, 4.0}) {
            EXPECT_NEAR(*first_of_all(cells, origin, length * direction) * length, *expected, 1e-12);
        }
    }
}

}  // namespace
}  // namespace stilb::geometry
