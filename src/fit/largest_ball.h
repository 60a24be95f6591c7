// The largest ball behind planes: a linear programme in its centre and radius.
#pragma once

#include <span>

#include "base/vec.h"

namespace stilb::fit {

/// The points x with dot(normal, x) <= offset; `normal` is a unit vector.
struct HalfSpace {
    Vec3 normal;
    double offset = 0;
};

/// `radius` may be negative: then no point is behind all planes, and the centre is the one that is least far
/// before any.
struct InnerBall {
    Vec3 center;
    double radius = 0;
};

/// The greatest radius with dot(normal, center) + radius <= offset for all walls. It lies among the points
/// within `reach` of the origin, or little farther where the walls leave it open. The radius is true of the
/// centre, and the greatest but for 1e-6 of `reach`.
InnerBall largest_ball(std::span<const HalfSpace> walls, double reach);

}  // namespace stilb::fit
