// Where the light of a luminance comes from.
#pragma once

#include <optional>

#include "run/result.h"

namespace stilb::io {

/// The surface point that reading `j` of a sensor is the luminance of: where the line of sight ends, or the
/// point of a goniometer. Nothing where the line of sight leaves the scene, and where the run did not tell.
std::optional<Vec3> sub_point(const SensorResult& result, const Sensor& sensor, std::size_t j);

}  // namespace stilb::io
