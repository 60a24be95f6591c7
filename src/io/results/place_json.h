// Where a reading is made and which way it looks, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "sensors/sensor.h"

namespace stilb::io {

nlohmann::ordered_json vector_json(const Vec3& v);

/// Position, and normal or direction or both.
nlohmann::ordered_json place_json(const Measurand& measurand);

}  // namespace stilb::io
