// Places and directions in words.
#pragma once

#include <string>

#include "sensors/sensor.h"

namespace stilb::cli {

std::string place_text(const Vec3& position);
std::string direction_text(const Vec3& direction);

/// Where a reading is made and which way it looks: "at ... facing ...".
std::string place_text(const Measurand& measurand);

}  // namespace stilb::cli
