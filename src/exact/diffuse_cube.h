// A closed cube whose faces are diffuse, lit by an isotropic point source in its middle.
#pragma once

#include <array>
#include <vector>

#include "base/vec.h"

namespace stilb::exact {

/// The faces divided into cells that are smaller towards the edges, by symmetry a sixteenth of a face with
/// unknowns. The cube has the side 1.
class CubeRaster {
  public:
    /// `cells` along an edge, an even number.
    explicit CubeRaster(int cells);

    /// The illuminance of a place after one or more reflections, if the source gives 1 lm and each cell is
    /// evenly lit. `x`, `y`: from a corner of the face.
    double indirect_illuminance(double reflectance, double x, double y) const;

  private:
    std::size_t number_of(int i, int j) const;
    std::vector<double> factors(double x, double y) const;
    std::vector<double> cell_illuminances(double reflectance) const;

    int cells_;
    std::vector<double> edges_;                  ///< between the cells, from 0 to 1
    std::vector<std::array<double, 2>> places_;  ///< of the cells with unknowns
    std::vector<std::vector<double>> factors_;   ///< from each of them, of all that are symmetric to another
};

/// Solves the radiosity equation on two rasters and extrapolates to none. Relative error below 2e-4, except
/// nearer than a fortieth of the side to an edge.
class DiffuseCube {
  public:
    /// Throws std::domain_error for values that are not positive.
    DiffuseCube(double side_m, double flux_lm);

    /// Straight from the source, on any face; `x_m`, `y_m` from the middle of the face.
    double direct_illuminance_lx(double x_m, double y_m) const;
    /// After one or more reflections. Throws std::domain_error for a reflectance that is not from 0 to below
    /// 1, and places outside of the face.
    double indirect_illuminance_lx(double reflectance, double x_m, double y_m) const;
    /// The mean over all six faces [lx], direct light and all reflections together.
    double mean_illuminance_lx(double reflectance) const;

  private:
    double side_m_, flux_lm_;
    CubeRaster coarse_{16}, fine_{32};
};

}  // namespace stilb::exact
