// Rasters of measuring points.
#pragma once

#include <algorithm>
#include <cmath>

namespace stilb::sensors {

/// The number of cells along a side; more than memory holds where they are small.
inline double cells_along(double side_m, double spacing_m) {
    return std::max(1.0, std::round(side_m / spacing_m));
}

}  // namespace stilb::sensors
