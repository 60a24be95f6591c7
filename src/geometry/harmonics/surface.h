// Star-shaped surfaces as series of spherical harmonics: |x| = R(x / |x|) about the origin [LocalEstimation
// 5].
#pragma once

#include <optional>

#include "base/vec.h"
#include "math/spherical_harmonics.h"

namespace stilb::geometry {

/// Where a ray crosses the surface.
struct HarmonicCrossing {
    double distance = 0;  ///< along the ray
    Vec3 direction;       ///< unit, from the origin
    bool is_entered = false;
};

/// Immutable. Lengths are in units of the series' values.
class HarmonicSurface {
  public:
    /// Throws InputError where R is not above 0 everywhere.
    explicit HarmonicSurface(math::HarmonicSeries<double> radius);

    const math::HarmonicSeries<double>& radius() const { return radius_; }
    /// Bounds of R, safe ones: within 4 % and a little more of the true ones.
    double least_radius() const { return least_radius_; }
    double greatest_radius() const { return greatest_radius_; }

    /// Unit, outwards, at the surface's point in a unit direction from the origin.
    Vec3 normal_at(const Vec3& direction) const;

    /// The first crossing of a ray with a unit direction between two distances. Certain: what it leaves out
    /// are pairs of crossings closer together than about 1e-9 of the radius, where the ray touches the
    /// surface.
    ///
    /// The ray and the origin span a plane, in which the ray is |x| = d / cos(a), where d is its distance
    /// from the origin and a the angle from its closest point. With M between the bounds of R, (R - M) cos(a)
    /// is a trigonometric polynomial of degree N = L + 1 there, so its second derivative is at most N^2 times
    /// its maximum [Bernstein], and that of M cos(a) at most M: intervals without a root of R cos(a) - d
    /// (T.5), and such with one, are known for certain.
    std::optional<HarmonicCrossing> first_crossing(const Vec3& origin, const Vec3& direction, double start,
                                                   double end) const;

  private:
    struct Line;

    std::optional<HarmonicCrossing> crossing_between(const Line& line, double low, double high) const;
    std::optional<HarmonicCrossing> crossing_of_arm(const Line& line, double low, double high) const;
    std::optional<HarmonicCrossing> crossing_of_arc(const Line& line, double low, double high) const;

    math::HarmonicSeries<double> radius_;
    double least_radius_ = 0, greatest_radius_ = 0;
};

}  // namespace stilb::geometry
