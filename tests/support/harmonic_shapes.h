// Surfaces by spherical harmonics for tests, and random numbers to aim at them with.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/harmonics/projection.h"
#include "geometry/harmonics/surface.h"
#include "math/random.h"
#include "math/sampling.h"
#include "support/scene_builder.h"

namespace stilb {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Numbers {
  public:
    explicit Numbers(std::uint64_t seed) : key_{seed} {}

    double next() { return math::unit_interval(random_block(key_, index_++, 0)[0]); }
    Vec3 direction() {
        const double u = next();
        return math::sample_sphere(u, next()).direction;
    }

  private:
    math::RandomKey key_;
    std::uint64_t index_ = 0;
};

/// The coefficient of a sphere of radius 1.
inline const double kUnitSphere = std::sqrt(4 * std::numbers::pi);

/// About 1, with a relief of some 15 % in all degrees.
inline geometry::HarmonicSurface rough_surface(int degree, std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> coefficients(math::harmonic_count(degree));
    for (double& c : coefficients) c = (numbers.next() - 0.5) * 1.6 / (degree + 1);
    coefficients[0] = kUnitSphere;
    return geometry::HarmonicSurface(math::HarmonicSeries<double>(coefficients));
}

/// A radius by direction, projected.
template <typename Radius>
geometry::HarmonicSurface surface_of(const Radius& radius, int degree) {
    const geometry::ParallelGrid grid = geometry::gauss_grid(2 * (degree + 1));
    std::vector<double> radii;
    for (const Vec3& direction : grid.directions()) radii.push_back(radius(direction));
    return geometry::HarmonicSurface(math::HarmonicSeries<double>(project(grid, radii, degree)));
}

/// Half axes along x, y and z, where the series has converged at that degree.
inline geometry::HarmonicSurface ellipsoid_surface(const Vec3& axes, int degree) {
    return surface_of(
        [&](const Vec3& d) {
            return 1 / length(Vec3{d.x / axes.x, d.y / axes.y, d.z / axes.z});
        },
        degree);
}

/// Of 1,310,720 triangles, fronts outside.
inline Mesh fine_mesh(const Harmonics& harmonics) {
    Mesh mesh = icosphere({{}, 1}, 8);
    for (Vec3& vertex : mesh.vertices) vertex = harmonics.point_towards(vertex);
    return mesh;
}

/// A rounded ellipsoid with a relief that falls off as a head's does: variances of coefficients like l^-5.
/// The radius' deviation is some 15 % in all.
inline geometry::HarmonicSurface head_like_surface(int degree, std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> coefficients(math::harmonic_count(degree));
    double power = 0;
    for (int l = 1; l <= degree; ++l) {
        for (int m = -l; m <= l; ++m) {
            double& c = coefficients[math::harmonic_number(l, m)];
            c = (numbers.next() - 0.5) * std::pow(l, -2.5);
            if (l == 2 && m == 0) c = 0.3;
            power += c * c;
        }
    }
    for (double& c : coefficients) c *= 0.15 * kUnitSphere / std::sqrt(power);
    coefficients[0] = kUnitSphere;
    return geometry::HarmonicSurface(math::HarmonicSeries<double>(coefficients));
}

/// With a relief so strong that its least radius is only `ratio` of the greatest: `falloff` 0 has all degrees
/// alike, and variances of coefficients fall like l^(-2 falloff) else.
inline geometry::HarmonicSurface strong_surface(int degree, double falloff, double ratio,
                                                std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> coefficients(math::harmonic_count(degree));
    for (int l = 1; l <= degree; ++l) {
        for (int m = -l; m <= l; ++m) {
            coefficients[math::harmonic_number(l, m)] = (numbers.next() - 0.5) * std::pow(l, -falloff);
        }
    }
    const math::HarmonicSeries<double> relief(coefficients);
    double least = 0, greatest = 0;
    for (int n = 0; n < 2000 + 40 * degree * degree; ++n) {
        const double value = relief.at(numbers.direction());
        least = std::min(least, value), greatest = std::max(greatest, value);
    }
    // 1 + scale least = ratio (1 + scale greatest)
    const double scale = (1 - ratio) / (ratio * greatest - least);
    for (double& c : coefficients) c *= scale;
    coefficients[0] = kUnitSphere;
    return geometry::HarmonicSurface(math::HarmonicSeries<double>(coefficients));
}

}  // namespace stilb
