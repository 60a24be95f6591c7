// A series of spherical harmonics on planes through an axis of coordinates, for many points at once: on the
// great circle of such a plane, and around the axis, it is a trigonometric polynomial of the series' degree
// L, which 2 L + 2 samples give exactly.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/spherical_harmonics.h"

namespace stilb::geometry {

/// Immutable.
class MeridianSeries {
  public:
    /// Of the planes through axis i, where (i, j, k) are (0, 1, 2), (1, 2, 0) or (2, 0, 1).
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

}  // namespace stilb::geometry
