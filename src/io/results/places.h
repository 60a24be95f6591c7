// Where readings are made, which way they look and what they see, as JSON and as columns.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "run/result.h"
#include "sensors/sensor.h"

namespace stilb::io {

nlohmann::ordered_json vector_json(const Vec3& v);

/// Position and directions, without the angles.
nlohmann::ordered_json place_json(const Place& place);

/// The surface point that reading `j` of a sensor is the luminance of: where the line of sight ends, or the
/// point of a goniometer. Nothing where the line of sight leaves the scene, and where the run did not tell.
std::optional<Vec3> sub_point(const SensorResult& result, const Sensor& sensor, std::size_t j);

}  // namespace stilb::io
