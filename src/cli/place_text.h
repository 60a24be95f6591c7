// Places and directions in words.
#pragma once

#include <string>

#include "sensors/measurand.h"

namespace stilb::cli {

std::string place_text(const Vec3& position);
std::string direction_text(const Vec3& direction);

/// Where a reading is made and which way it looks: "at ... facing ...".
std::string place_text(const Place& place);
/// "theta 30°  phi 0°"; empty where a place has no angles.
std::string angles_text(const Place& place);

}  // namespace stilb::cli
