// Positions, directions and seen points of readings, as JSON and as columns.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "run/result.h"
#include "sensors/sensor.h"

namespace stilb::io {

nlohmann::ordered_json vector_json(const Vec3& v);

/// Position and directions, without the angles.
nlohmann::ordered_json location_json(const Location& location);

/// The surface point whose luminance reading `j` of a sensor is: the end of the line of sight, or the
/// point of a goniometer. Nothing where the line of sight leaves the scene, or the run did not record it.
std::optional<Vec3> sub_point(const SensorResult& result, const Sensor& sensor, std::size_t j);

}  // namespace stilb::io
