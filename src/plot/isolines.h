// Lines of equal value over a grid.
#pragma once

#include <span>
#include <vector>

#include "plot/canvas.h"

namespace stilb::plot {

/// Polylines on which the grid's value is `level`, by marching squares between cell centres. `values` are nu
/// x nv, u fastest; NaN leaves a hole. x counts cells along u (0 to nu), y along v (0 to nv); values of the
/// border cells reach to the grid's edge. Closed lines repeat their first point.
std::vector<std::vector<Point>> find_isolines(std::span<const double> values, int nu, int nv, double level);

}  // namespace stilb::plot
