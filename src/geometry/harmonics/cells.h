// A surface by spherical harmonics as small cells with a polynomial each: fast for many rays.
//
// On a face of a cube about the origin, x_k the coordinate across it, a direction is s = x_i / x_k, t = x_j /
// x_k, and the surface is
//
//     w = W(s, t) = sqrt(1 + s^2 + t^2) / R,    w = 1 / x_k.
//
// (s, t, w) is a projective map, so a ray is a straight line there, too: in a cell, a rectangle where W is a
// polynomial of s and t, W - w along a ray is a polynomial of one variable. A quadratic with bounds of its
// remainder rejects most rays that pass by, and shows where there is at most one root; otherwise a bound of
// the second derivative makes the first root certain (first_root.h). Cells interpolate W at Chebyshev's
// points with the ends (Lobatto), so that neighbours agree on their edge: the surface has no gaps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/rays.h"
#include "base/vec.h"
#include "geometry/harmonics/cell_polynomial.h"
#include "geometry/harmonics/surface.h"
#include "math/sampling.h"

namespace stilb::geometry {

// Faces of a cube about the origin.

/// The axes (i, j, k) of a face and the sign of x_k.
struct CubeFace {
    std::size_t i, j, k;
    double sign;

    explicit CubeFace(std::size_t number)
        : i((number / 2 + 1) % 3), j((number / 2 + 2) % 3), k(number / 2), sign(number % 2 == 0 ? 1 : -1) {}

    /// (x_i, x_j, |x_k|).
    Vec3 to_local(const Vec3& x) const { return {x[i], x[j], sign * x[k]}; }
    Vec3 to_world(const Vec3& local) const {
        std::array<double, 3> x{};
        x[i] = local.x, x[j] = local.y, x[k] = sign * local.z;
        return {x[0], x[1], x[2]};
    }
};

/// Immutable. Lengths are in units of the series' values. Directions of rays may have any length but 0;
/// distances along a ray are in units of it.
class HarmonicCells {
  public:
    /// Chooses the number of cells, nearly equal in angle, such that the polynomials differ from the surface
    /// by at most `tolerance` of R, at points between the interpolated ones. Throws std::invalid_argument
    /// where the tolerance is below 1e-11.
    explicit HarmonicCells(const HarmonicSurface& surface, double tolerance = 1e-7);

    std::size_t count() const { return outlines_.size(); }
    /// The largest difference found, as a share of R.
    double error() const { return error_; }
    Bounds bounds_of(std::size_t cell) const;
    std::size_t bytes() const { return count() * (sizeof(Outline) + sizeof(Polynomial)); }

    /// The distance of the first crossing in a cell; infinite where there is none.
    double crossing(std::size_t cell, const Vec3& origin, const Vec3& direction, double start,
                    double end) const;

    /// The result of crossing(), where single precision suffices for certainty.
    LaneClassifications classifications(std::size_t cell, const RayPacket& rays,
                                        const PacketPlacement& placement) const;

    /// By the cell's polynomial: at the default tolerance the normal is within about 3e-5 rad of
    /// HarmonicSurface::normal_at(), mostly within 2e-6.
    struct Point {
        Vec3 position;
        Vec3 normal;  ///< unit, outwards
    };
    /// The surface's point on the line from the origin through `near_by`, which is in or near a cell.
    Point point_at(std::size_t cell, const Vec3& near_by) const;

    struct Element : Point {
        double area = 0;  ///< by a and b: of a square in which they change by 1
    };
    /// At a and b from -1 to 1 over a cell.
    Element element_at(std::size_t cell, double a, double b) const;

  private:
    static constexpr std::size_t kNodes = 8;  ///< along an edge
    using Polynomial = Matrix<kNodes>;        ///< of a and b, which go from -1 to 1 over the cell

    /// The bounds of a row or column of cells, in s or t.
    struct Span {
        double middle = 0, half = 0;
    };
    /// The data for rejecting a ray: one cache line.
    struct alignas(64) Outline {
        float low = 0, high = 0;  ///< bounds of x_k
        Quadratic quadratic{};    ///< about W
        float rest = 0;           ///< bounds of W - quadratic and of its derivatives
        float rest_a = 0, rest_b = 0, rest_aa = 0, rest_ab = 0, rest_bb = 0;
        std::uint16_t face = 0;  ///< 2 k, and 1 more where x_k < 0
        std::uint16_t column = 0, row = 0;
    };
    struct Line;
    struct FloatCell;

    bool divide(const std::array<MeridianSeries, 3>& series, std::size_t on_edge, double tolerance);
    void fill_face(const MeridianSeries& series, double sign);
    double error_of_face(const MeridianSeries& series, double sign, std::size_t first_cell) const;
    Outline outline_of(std::size_t cell) const;
    double root_on(const Line& line, std::size_t cell) const;

    std::vector<Span> spans_;
    std::vector<Outline> outlines_;
    std::vector<Polynomial> polynomials_;  ///< coefficients of a^p b^q
    double error_ = 0;
};

// Area of surfaces by harmonics, and points on them by area.

class HarmonicCells;

/// Immutable. Areas are in squares of the series' units.
class HarmonicArea {
  public:
    /// The area element is exact for the cells' polynomials, and summed over each by Gauss's rule.
    explicit HarmonicArea(std::shared_ptr<const HarmonicCells> cells);

    double total() const { return by_area_.total(); }

    struct Point {
        Vec3 position, normal;  ///< unit, outwards
        double pdf_per_area = 0;
    };
    /// In a cell drawn by area, uniform in its coordinates: nearly uniform by area.
    Point sample(const std::array<double, 2>& u) const;

  private:
    std::shared_ptr<const HarmonicCells> cells_;
    math::DiscreteDistribution by_area_;
};

}  // namespace stilb::geometry
