// The floor plan: rooms and furniture from above, luminaires, measured areas with isolux lines, single
// sensors. Rooms with sensors have plans of their own where these are at least twice as large.
#pragma once

#include <span>

#include "rays/ray_caster.h"
#include "report/html.h"
#include "report/measured_plane.h"
#include "run/result.h"
#include "scene/scene.h"

namespace stilb::report {

/// Nothing where the scene has no extent. `planes`: those of the results.
Html floor_plans(const Scene& scene, const rays::RayCaster& caster, std::span<const SensorResult> results,
                 std::span<const MeasuredPlane> planes);

}  // namespace stilb::report
