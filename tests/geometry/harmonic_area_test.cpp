#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "geometry/harmonics/cells.h"
#include "geometry/harmonics/surface.h"
#include "geometry/transform.h"
#include "support/harmonic_shapes.h"
#include "support/quadrature.h"

namespace stilb::geometry {
namespace {

double area_of(const HarmonicSurface& surface) { return area_m2(Harmonics(surface)); }

/// R sqrt(R^2 + |grad R|^2), summed over many directions.
double area_by_the_series(const HarmonicSurface& surface) {
    const ParallelGrid grid = gauss_grid(16 * (surface.radius().degree() + 1));
    double area = 0;
    for (std::size_t parallel = 0; parallel < grid.parallels(); ++parallel) {
        for (std::size_t k = 0; k < grid.azimuths; ++k) {
            const auto [radius, gradient] = surface.radius().with_gradient(grid.direction(parallel, k));
            area +=
                grid.weights_sr[parallel] * radius * std::sqrt(radius * radius + squared_length(gradient));
        }
    }
    return area;
}

/// Of a spheroid of half axes 1, 1 and `c`, by the surface of revolution.
double spheroid_area(double c) {
    return integrate(0, std::numbers::pi, 64, [&](double t) {
        const double sine = std::sin(t), cosine = std::cos(t);
        return 2 * std::numbers::pi * sine * std::sqrt(c * c * sine * sine + cosine * cosine);
    });
}

TEST(HarmonicArea, OfASphereIsExact) {
    const HarmonicSurface sphere(math::HarmonicSeries<double>(std::vector{3 * kUnitSphere}));
    EXPECT_NEAR(area_of(sphere), 36 * std::numbers::pi, 1e-7 * 36 * std::numbers::pi);
}

TEST(HarmonicArea, OfASpheroidIsExact) {
    for (const double c : {0.7, 1.3}) {
        EXPECT_NEAR(area_of(ellipsoid_surface({1, 1, c}, 40)), spheroid_area(c), 1e-6) << c;
    }
}

TEST(HarmonicArea, OfARoughSurfaceIsThatOfAFineMesh) {
    for (const int degree : {1, 9}) {
        const Harmonics harmonics(rough_surface(degree, 2));
        const double mesh_m2 = area_m2(fine_mesh(harmonics));
        EXPECT_NEAR(area_m2(harmonics), mesh_m2, 2e-4 * mesh_m2) << degree;
    }
}

/// By another rule, on which the cells have no say.
TEST(HarmonicArea, IsThatOfTheSeries) {
    for (const int degree : {5, 30}) {
        const HarmonicSurface surface = rough_surface(degree, 2);
        const double area = area_of(surface);
        EXPECT_NEAR(area_by_the_series(surface), area, 1e-6 * area) << degree;
    }
}

/// Points lie on the surface with its normal; one over their density is the area, and so for parts of it.
TEST(HarmonicArea, SamplesHaveTheDensityThatTheySay) {
    const Harmonics shape(rough_surface(8, 4));
    constexpr int count = 200'000;
    Numbers numbers(1);
    double above = 0, squares = 0, flux = 0, flux_squares = 0;
    for (int i = 0; i < count; ++i) {
        const double u = numbers.next();
        const HarmonicArea::Point point = shape.area->sample({u, numbers.next()});
        const Vec3 direction = normalized(point.position);
        if (i % 100 == 0) {
            ASSERT_NEAR(length(point.position), shape.surface->radius().at(direction), 2e-7);
            ASSERT_LT(length(point.normal - shape.surface->normal_at(direction)), 2e-5);
        }
        const double part = point.position.z > 0.3 ? 1 / point.pdf_per_area : 0;
        above += part / count, squares += part * part / count;
        const double through = dot(point.position, point.normal) / point.pdf_per_area;
        flux += through / count, flux_squares += through * through / count;
    }
    const Mesh mesh = fine_mesh(shape);
    double expected = 0, volume = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
        if (p.z + q.z + r.z > 0.9) expected += length(cross(q - p, r - p)) / 2;
        volume += dot(p, cross(q, r)) / 6;
    }
    EXPECT_NEAR(above, expected, 4 * std::sqrt((squares - above * above) / count) + 1e-3 * expected);
    // Gauss: the flux of x through a closed surface is three times the volume.
    EXPECT_NEAR(flux, 3 * volume, 4 * std::sqrt((flux_squares - flux * flux) / count) + 1e-4 * volume);
}

TEST(Harmonics, TurnAndGrowAboutTheirCenter) {
    Harmonics harmonics(rough_surface(6, 7));
    harmonics.center = {1, 2, 3};
    const Transform turn = Transform::rotation(normalized(Vec3{1, 1, 0}), 40);
    const Transform transform = compose(Transform{{2, 0, 0}, {0, -2, 0}, {0, 0, 2}, {0.5, 0, 0}}, turn);
    const Shape moved = transformed(harmonics, transform);
    Numbers numbers(3);
    for (int i = 0; i < 50; ++i) {
        const Vec3 direction = numbers.direction();
        const Vec3 expected = transform.point(harmonics.point_towards(direction));
        const auto& shape = std::get<Harmonics>(moved);
        EXPECT_LT(length(shape.point_towards(transform.direction(direction)) - expected), 1e-12);
        const Vec3 normal = normalized(transform.direction(harmonics.normal_towards(direction)));
        EXPECT_LT(length(shape.normal_towards(transform.direction(direction)) - normal), 1e-12);
    }
    EXPECT_NEAR(area_m2(moved), 4 * area_m2(harmonics), 1e-9);
}

}  // namespace
}  // namespace stilb::geometry
