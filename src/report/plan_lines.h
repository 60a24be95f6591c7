// The lines of a floor plan.
#pragma once

#include <array>
#include <vector>

#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::report {

struct PlanPoint {
    double x = 0, y = 0;  ///< [m]
};
using PlanLine = std::array<PlanPoint, 2>;

/// A horizontal section: what is above its height is left out.
struct PlanLines {
    double height_m = 0;         ///< coordinate z
    std::vector<PlanLine> cut;   ///< where the surfaces are cut
    std::vector<PlanLine> seen;  ///< edges below that are seen from there
};

/// 1.2 m above the lowest point of the scene, or its middle where it is lower than twice that.
double usual_plan_height(const Bounds& bounds);

/// The section at a height [m]. Luminaires are left out, and things that are too small on the plan.
PlanLines plan_lines(const Scene& scene, const rays::RayCaster& caster, double height_m);

/// The outline of a shape from above: its convex hull, counterclockwise.
std::vector<PlanPoint> outline_from_above(const Shape& shape);

}  // namespace stilb::report
