// Functions over the directions of a hemisphere, as polynomials on the unit disk of its projection.
//
// A unit direction (x, y, z), z >= 0, lies above the point (x, y) of the unit disk, and the area there is the
// projected solid angle cos(theta) dw [Nusselt]. Zernike's polynomials are orthogonal on the disk [Born and
// Wolf, Principles of Optics, 9.2], so these are on the hemisphere:
//
//     integral of Z_i Z_j cos(theta) dw = 1 where i = j, else 0.
//
// Those up to degree n span all polynomials in x and y up to degree n: the same as the spherical harmonics up
// to degree n that are even about the surface's plane. Constant light is Z_0 alone.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace stilb::math {

class ZernikeBasis {
  public:
    static constexpr int kMostDegree = 12;
    static constexpr std::size_t kMostCount = (kMostDegree + 1) * (kMostDegree + 2) / 2;

    /// The basis of all polynomials up to `degree`, from 0 to kMostDegree.
    explicit ZernikeBasis(int degree);

    int degree() const { return degree_; }
    /// (degree + 1) (degree + 2) / 2.
    std::size_t count() const { return norms_.size(); }

    /// Writes the count() values [1/sqrt(sr)] at a unit direction with z >= 0, in the order (n, m) = (0, 0),
    /// (1, -1), (1, 1), (2, -2), (2, 0), (2, 2) ...: number (n (n + 2) + m) / 2, with sin |m| phi where m <
    /// 0.
    void evaluate(const Vec3& direction, std::span<double> values) const;

  private:
    /// The recurrence of radial polynomials of one m: p_k+1 = (a t + b) p_k - c p_k-1, t = 2 r^2 - 1.
    struct Recurrence {
        double a = 0, b = 0, c = 0;
    };

    int degree_;
    std::vector<double> norms_;
    std::vector<Recurrence> recurrences_;  ///< m by m, each for k = 0, 1 ... while m + 2 k <= degree
};

}  // namespace stilb::math
