// The table of the materials of a scene.
#pragma once

#include "report/html.h"
#include "scene/scene.h"

namespace stilb::report {

/// Nothing where there are none.
Html materials_table(const Scene& scene);

}  // namespace stilb::report
