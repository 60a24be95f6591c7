// Sampling of directions and points from two numbers in [0, 1), each with its density.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "base/vec.h"

namespace stilb::math {

/// The largest number below 1: rounding must not move a number in [0, 1) beyond it.
inline constexpr double kBelowOne = 0x1.fffffffffffffp-1;

/// The rotation between consecutive directions that never lets them line up [rad].
inline constexpr double kGoldenAngle = 2 * std::numbers::pi * (2 - std::numbers::phi);

struct DirectionSample {
    Vec3 direction;  ///< unit vector
    double pdf_per_sr = 0;
};

/// A point of the unit disk, uniform in area; concentric map, which keeps low discrepancy.
struct DiskPoint {
    double x = 0, y = 0;
};
DiskPoint sample_unit_disk(double u1, double u2);

/// About +z, density cos(theta)/pi.
DirectionSample sample_cosine_hemisphere(double u1, double u2);
constexpr double cosine_hemisphere_pdf_per_sr(double cos_theta) {
    return cos_theta > 0 ? cos_theta / std::numbers::pi : 0;
}
/// About +z: number `i` of `count` directions that are spread evenly, by density cos(theta)/pi; none lies in
/// the plane. `count`: a power of two.
Vec3 cosine_direction(std::uint32_t i, std::uint32_t count);

/// Uniform over the sphere.
DirectionSample sample_sphere(double u1, double u2);

/// Uniform over the cone about +z with half-angle theta_max, given as 1 - cos(theta_max) so that narrow cones
/// stay exact.
DirectionSample sample_cone(double one_minus_cos_max, double u1, double u2);

/// About +z, density (n+1)/(2 pi) cos^n(theta).
DirectionSample sample_cosine_power(double exponent, double u1, double u2);

/// Barycentric coordinates, uniform over a triangle's area.
struct Barycentric {
    double b0 = 0, b1 = 0, b2 = 0;
};
Barycentric sample_triangle(double u1, double u2);

// Choosing one of several by weight.

struct DiscreteChoice {
    std::size_t index = 0;
    double probability = 1;
    double remainder = 0;  ///< uniform in [0, 1), independent of the choice
};

/// Samples an index by running sums of weights, as DiscreteDistribution; the last sum is above 0.
DiscreteChoice choose_by_sums(std::span<const double> sums, double u);

/// Samples indices in proportion to fixed weights, by inversion: neighbouring numbers give neighbouring
/// indices, and the remainder of the number can be used again.
class DiscreteDistribution {
  public:
    DiscreteDistribution() = default;
    /// Preconditions: weights are finite, none is negative, at least one is positive.
    explicit DiscreteDistribution(std::span<const double> weights);

    DiscreteChoice choose(double u) const { return choose_by_sums(cumulative_, u); }
    double probability(std::size_t index) const;

    double total() const { return cumulative_.empty() ? 0 : cumulative_.back(); }

  private:
    std::vector<double> cumulative_;
};

}  // namespace stilb::math
