// How a run ended, for people.
#pragma once

#include <string>
#include <string_view>

#include "run/result.h"

namespace stilb::cli {

/// `all`: what was done where a number of it was asked for, such as "passes".
std::string ending(StopReason reason, std::string_view all);

}  // namespace stilb::cli
