// Area of surfaces by harmonics, and points on them by area.
#pragma once

#include <array>
#include <memory>

#include "base/vec.h"
#include "math/discrete.h"

namespace stilb::geometry {

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
