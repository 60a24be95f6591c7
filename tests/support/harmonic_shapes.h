// Surfaces by spherical harmonics for tests, and random numbers to aim at them with.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "base/sampling.h"
#include "scene/harmonic_surface.h"
#include "support/scene_builder.h"

namespace stilb {

class Numbers {
  public:
    explicit Numbers(std::uint64_t seed) : key_{seed} {}

    double next() { return unit_interval(random_block(key_, index_++, 0)[0]); }
    Vec3 direction() {
        const double u = next();
        return sample_sphere(u, next()).direction;
    }

  private:
    RandomKey key_;
    std::uint64_t index_ = 0;
};

/// The coefficient of a sphere of radius 1.
inline const double kUnitSphere = std::sqrt(4 * std::numbers::pi);

/// About 1, with a relief of some 15 % in all degrees.
inline HarmonicSurface rough_surface(int degree, std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> coefficients(harmonic_count(degree));
    for (double& c : coefficients) c = (numbers.next() - 0.5) * 1.6 / (degree + 1);
    coefficients[0] = kUnitSphere;
    return HarmonicSurface(HarmonicSeries<double>(coefficients));
}

/// Of 1,310,720 triangles, fronts outside.
inline Mesh fine_mesh(const Harmonics& harmonics) {
    Mesh mesh = icosphere({{}, 1}, 8);
    for (Vec3& vertex : mesh.vertices) vertex = harmonics.point_towards(vertex);
    return mesh;
}

/// A rounded ellipsoid with a relief that falls off as a head's does: variances of coefficients like l^-5.
/// The radius' deviation is some 15 % in all.
inline HarmonicSurface head_like_surface(int degree, std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> coefficients(harmonic_count(degree));
    double power = 0;
    for (int l = 1; l <= degree; ++l) {
        for (int m = -l; m <= l; ++m) {
            double& c = coefficients[harmonic_number(l, m)];
            c = (numbers.next() - 0.5) * std::pow(l, -2.5);
            if (l == 2 && m == 0) c = 0.3;
            power += c * c;
        }
    }
    for (double& c : coefficients) c *= 0.15 * kUnitSphere / std::sqrt(power);
    coefficients[0] = kUnitSphere;
    return HarmonicSurface(HarmonicSeries<double>(coefficients));
}

/// With a relief so strong that its least radius is only `ratio` of the greatest: `falloff` 0 has all degrees
/// alike, and variances of coefficients fall like l^(-2 falloff) else.
inline HarmonicSurface strong_surface(int degree, double falloff, double ratio, std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> coefficients(harmonic_count(degree));
    for (int l = 1; l <= degree; ++l) {
        for (int m = -l; m <= l; ++m) {
            coefficients[harmonic_number(l, m)] = (numbers.next() - 0.5) * std::pow(l, -falloff);
        }
    }
    const HarmonicSeries<double> relief(coefficients);
    double least = 0, greatest = 0;
    for (int n = 0; n < 2000 + 40 * degree * degree; ++n) {
        const double value = relief.at(numbers.direction());
        least = std::min(least, value), greatest = std::max(greatest, value);
    }
    // 1 + scale least = ratio (1 + scale greatest)
    const double scale = (1 - ratio) / (ratio * greatest - least);
    for (double& c : coefficients) c *= scale;
    coefficients[0] = kUnitSphere;
    return HarmonicSurface(HarmonicSeries<double>(coefficients));
}

/// The series of a function of directions, which must have no more than `degree` for it to be exact: by
/// Fejer's first rule in the polar angle, and equal steps about the pole.
template <typename Function>
HarmonicSeries<double> harmonic_projection(const Function& function, int degree) {
    const int parallels = 2 * degree + 2, meridians = 2 * degree + 2;
    std::vector<double> coefficients(harmonic_count(degree)), values(harmonic_count(degree));
    for (int k = 0; k < parallels; ++k) {
        const double theta = std::numbers::pi * (k + 0.5) / parallels;
        double sum = 1;
        for (int n = 1; 2 * n < parallels; ++n) sum -= 2 * std::cos(2 * n * theta) / (4. * n * n - 1);
        const double weight = 2 * sum / parallels * 2 * std::numbers::pi / meridians;
        for (int m = 0; m < meridians; ++m) {
            const double phi = 2 * std::numbers::pi * m / meridians;
            const Vec3 direction{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 std::cos(theta)};
            evaluate_harmonics(direction, degree, values);
            const double value = weight * function(direction);
            for (std::size_t n = 0; n < values.size(); ++n) coefficients[n] += value * values[n];
        }
    }
    return HarmonicSeries<double>(coefficients);
}

}  // namespace stilb
