// Star-shaped surfaces as series of spherical harmonics: |x| = R(x / |x|) about the origin [LocalEstimation
// 5].
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

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
    /// Throws InputError where R is not positive everywhere.
    explicit HarmonicSurface(math::HarmonicSeries<double> radius);

    const math::HarmonicSeries<double>& radius() const { return radius_; }
    /// Guaranteed bounds of R: within 4 % and a little more of the true ones.
    double least_radius() const { return least_radius_; }
    double greatest_radius() const { return greatest_radius_; }

    /// Unit, outwards, at the surface's point in a unit direction from the origin.
    Vec3 normal_at(const Vec3& direction) const;

    /// The first crossing of a ray with a unit direction between two distances. It is certain, except for
    /// pairs of crossings closer together than about 1e-9 of the radius, where the ray touches the
    /// surface.
    ///
    /// The ray and the origin span a plane, in which the ray is |x| = d / cos(a), where d is its distance
    /// from the origin and a the angle from its closest point. With M between the bounds of R, (R - M) cos(a)
    /// is a trigonometric polynomial of degree N = L + 1 there, so its second derivative is at most N^2 times
    /// its maximum [Bernstein], and that of M cos(a) at most M: intervals without a root of R cos(a) - d
    /// (T.5), and intervals with one, are certain.
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

// Directions on parallels of the sphere, evenly spaced on each parallel.

/// Values on it are numbered parallel by parallel: parallel * azimuths + k for phi = first_phi + 2 pi k /
/// azimuths.
struct ParallelGrid {
    std::vector<double> z;           ///< cos(theta) per parallel
    std::vector<double> weights_sr;  ///< per parallel, of each of its directions; they sum up to 4 pi
    std::size_t azimuths = 0;
    double first_phi = 0;

    std::size_t parallels() const { return z.size(); }
    std::size_t size() const { return z.size() * azimuths; }
    double phi(std::size_t k) const;
    /// The unit vector.
    Vec3 direction(std::size_t parallel, std::size_t k) const;
    /// All directions, in their order.
    std::vector<Vec3> directions() const;
};

/// Gauss-Legendre nodes in cos(theta), twice as many azimuths as parallels: sums over it are integrals of
/// spherical harmonics, exactly, up to degree 2 parallels - 1.
ParallelGrid gauss_grid(int parallels);

/// Parallels in the middles of even steps of theta, weighted by their area.
ParallelGrid even_grid(int parallels);

// A series of spherical harmonics on planes through an axis of coordinates, for many points at once: on the
// great circle of such a plane, and around the axis, it is a trigonometric polynomial of the series' degree
// L, which 2 L + 2 samples give exactly.

/// Immutable.
class MeridianSeries {
  public:
    /// Precomputes the planes through axis i, where (i, j, k) are (0, 1, 2), (1, 2, 0) or (2, 0, 1).
    MeridianSeries(const math::HarmonicSeries<double>& series, std::size_t i);

    /// The series' values in the directions of (x_i, x_j, x_k) = (s, t, z), one for each s. z is not 0.
    void evaluate(std::span<const double> s, double t, double z, std::span<double> values) const;

  private:
    /// Coefficients of cos(n e) and sin(n e), e the elevation over the plane across the axis.
    struct Pair {
        double cosine = 0, sine = 0;
    };
    using Meridian = std::vector<Pair>;  ///< n = 0, 1 ... L

    Meridian meridian_at(double azimuth) const;

    std::size_t degree_ = 0;
    std::vector<Meridian> meridians_;  ///< at azimuths 2 pi n / (2 L + 2)
};

// The first crossing of a ray and a surface by spherical harmonics as in [LocalEstimation 5]: steps along the
// ray until the side changes, then halving. For comparison: what lies within one step is missed
// (HarmonicSurface::first_crossing() misses nothing).

/// A step's length as a share of the greatest radius. The paper states none.
inline constexpr double kMarchedShare = 0.02;

/// Between two distances along a unit direction, in equal steps from where the ray enters the sphere that
/// holds the surface (or from `start`); halved until rounding ends it.
std::optional<HarmonicCrossing> march_crossing(const HarmonicSurface& surface, const Vec3& origin,
                                               const Vec3& direction, double start, double end, double step);

}  // namespace stilb::geometry
