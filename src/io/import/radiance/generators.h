// The program genbox, which makes surfaces.
#pragma once

#include <string>
#include <vector>

#include "io/import/radiance/primitives.h"

namespace stilb::io::radiance {

/// Adds the surfaces of "genbox material name x y z [-i] [-b bevel | -r round]". Throws InputError without a
/// place.
void run_genbox(const std::vector<std::string>& arguments, const Place& place, Collector& collector);

}  // namespace stilb::io::radiance
