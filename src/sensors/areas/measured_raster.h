// The rasters on which grids and areas are measured.
#pragma once

#include <cstddef>
#include <vector>

#include "sensors/sensor.h"

namespace stilb::sensors {

/// Null for sensors without a raster, such as areas on objects.
const Grid* raster_of(const Sensor& sensor);
/// The number of the cell, u fastest, of each reading of a sensor with a raster: cells of areas may have
/// none.
std::vector<std::size_t> cells_of_readings(const Sensor& sensor);

}  // namespace stilb::sensors
