// A surface by spherical harmonics in small cells with a polynomial each: for many rays.
//
// On a face of a cube about the origin, x_k the coordinate across it, a direction is s = x_i / x_k, t = x_j /
// x_k, and the surface is
//
//     w = W(s, t) = sqrt(1 + s^2 + t^2) / R,    w = 1 / x_k.
//
// (s, t, w) is a projective map, so a ray is a straight line there, too: in a square cell, where W is a
// polynomial of s and t, W - w along a ray is a polynomial of one variable with a known bound of its second
// derivative, and its first root is certain (first_root.h). Cells interpolate W at Chebyshev's points with
// the ends (Lobatto), so that neighbours agree on their edge: the surface has no gaps.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "scene/bounds.h"
#include "scene/harmonic_surface.h"

namespace stilb {

/// Immutable. Lengths are in units of the series' values. Directions of rays may have any length but 0;
/// distances along a ray are in units of it.
class HarmonicCells {
  public:
    /// As many cells as make the polynomials differ from the surface by `tolerance` of R at most, at points
    /// between those that are interpolated.
    explicit HarmonicCells(const HarmonicSurface& surface, double tolerance = 1e-7);

    std::size_t count() const { return cells_.size(); }
    /// The largest difference that was found, as a share of R.
    double error() const { return error_; }
    Bounds bounds_of(std::size_t cell) const;
    std::size_t bytes() const { return cells_.size() * sizeof(Cell); }

    /// The distance of the first crossing in a cell.
    std::optional<double> crossing(std::size_t cell, const Vec3& origin, const Vec3& direction, double start,
                                   double end) const;

    struct Place {
        Vec3 position;
        Vec3 normal;  ///< unit, outwards
    };
    /// The surface's point on the line from the origin through `near_by`, which is in or near a cell. By the
    /// cell's polynomial: at the default tolerance the normal is within about 1e-5 rad of
    /// HarmonicSurface::normal_at().
    Place place_at(std::size_t cell, const Vec3& near_by) const;

  private:
    static constexpr std::size_t kNodes = 7;  ///< along an edge
    using Coefficients = std::array<std::array<double, kNodes>, kNodes>;

    struct Cell {
        std::size_t face = 0;      ///< 2 k, and 1 more where x_k < 0
        double s = 0, t = 0;       ///< of the middle
        Coefficients polynomial;   ///< of a and b, which go from -1 to 1 over the cell: a^p b^q
        double low = 0, high = 0;  ///< bounds of x_k
        double curvature_aa = 0, curvature_ab = 0, curvature_bb = 0;  ///< bounds of second derivatives
    };

    bool divide(const HarmonicSurface& surface, std::size_t cells_on_edge, double tolerance);
    Cell make_cell(const HarmonicSurface& surface, std::size_t face, double s, double t) const;
    double error_of(const HarmonicSurface& surface, const Cell& cell) const;

    std::vector<Cell> cells_;
    double half_ = 0;  ///< of a cell's edge, in s and t
    double error_ = 0;
};

}  // namespace stilb
