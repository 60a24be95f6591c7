// A scene turned, mirrored, scaled and moved, key by key.
#pragma once

#include "random/draft.h"

namespace stilb::random {

/// x -> shift + scale * (columns of the images of the axes).
struct Motion {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    double scale = 1;
    Vec3 shift{};
    /// Turn about the z axis, of which spins and azimuths know; 0 where the turn is another one.
    double turn_deg = 0;
    bool is_mirrored = false;

    Vec3 direction(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
    Vec3 vector(const Vec3& v) const { return scale * direction(v); }
    Vec3 point(const Vec3& p) const { return shift + vector(p); }
};

/// About an axis (unit).
Motion turn_about(const Vec3& axis, double angle_deg);

/// Whether something in the scene knows up from down, or left from right beside the vertical: it can then be
/// turned about the vertical alone.
bool depends_on_vertical(const Draft& draft);
/// Whether something differs from its mirror image.
bool depends_on_hand(const Draft& draft);

/// A scene that moves keeps its light; fluxes grow with the square of its scale.
Draft in_motion(Draft draft, const Motion& motion);

/// The largest coordinate.
double farthest_coordinate(const Draft& draft);

}  // namespace stilb::random
