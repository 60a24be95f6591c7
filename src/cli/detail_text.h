// Which objects were given fewer harmonics than they have, as text for people.
#pragma once

#include <span>
#include <string>

#include "run/result.h"

namespace stilb::cli {

/// A line for each.
std::string detail_text(std::span<const run::LevelOfDetail> levels);

}  // namespace stilb::cli
