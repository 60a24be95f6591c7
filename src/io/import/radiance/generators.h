// The programs genbox and genrev, which make surfaces.
#pragma once

#include <string>
#include <vector>

#include "io/import/radiance/primitives.h"

namespace stilb::io::radiance {

/// Adds the surfaces of "genbox material name x y z [-i] [-b bevel | -r round]". Throws InputError without a
/// place.
void run_genbox(const std::vector<std::string>& arguments, const Place& place, Collector& collector);
/// The same of "genrev material name z(t) r(t) segments [-e definitions]"; returns whether it was asked for
/// smooth normals across its segments (-s), which are left out.
bool run_genrev(const std::vector<std::string>& arguments, const Place& place, Collector& collector);

}  // namespace stilb::io::radiance
