// Area of surfaces by harmonics, and points on them by area.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "base/discrete.h"
#include "base/vec.h"

namespace stilb {

class HarmonicSurface;

/// Immutable. Areas are in squares of the series' units.
class HarmonicArea {
  public:
    /// The area element R sqrt(R^2 + |grad R|^2), which is exact, summed by Gauss's rule in cells on the
    /// faces of a cube that are small next to the finest harmonic.
    explicit HarmonicArea(std::shared_ptr<const HarmonicSurface> surface);

    double total() const { return by_area_.total(); }

    struct Point {
        Vec3 position, normal;  ///< unit, outwards
        double pdf_per_area = 0;
    };
    /// In a cell drawn by area, uniform on the cube's face: nearly uniform by area.
    Point sample(const std::array<double, 2>& u) const;

  private:
    /// Position, normal, and area by s and t, on a face of the cube.
    struct Element {
        Vec3 position, normal;
        double area = 0;
    };
    Element element_at(std::size_t face, double s, double t) const;

    std::shared_ptr<const HarmonicSurface> surface_;
    std::size_t cells_on_edge_;
    double half_;  ///< of a cell's edge, where the face's is 1
    DiscreteDistribution by_area_;
};

}  // namespace stilb
