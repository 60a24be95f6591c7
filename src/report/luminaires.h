// The luminaires of a scene: a sheet for each luminaire file, and a table of all lamps.
#pragma once

#include "report/html.h"
#include "scene/scene.h"

namespace stilb::report {

/// Nothing where there are no lights.
Html luminaires_section(const Scene& scene);

/// The intensities of a luminaire in the planes C0-C180 and C90-C270, in cd per 1000 lm of its flux.
Html polar_curve(const PhotometricSolid& solid);

}  // namespace stilb::report
