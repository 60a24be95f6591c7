// Where light is measured: beside a point that lies exactly in a wall, on an edge or in a corner.
//
// In a corner neither the sides nor the distances of the walls are certain: light that arrives along a wall
// has a cosine of 0 or not, by rounding, and light from the wall itself comes from a distance of 0. The right
// value is the limit from inside, so the point moves inside by kEdgeMargin offsets of rays
// (rays/surface_packet.h).
#pragma once

#include <optional>

#include "rays/ray_caster.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

/// A place with the normal of its measuring point, which is 0 for a body that stands free.
struct Place : SurfacePoint {
    Vec3 lift{};                         ///< off the surface that the position lies on; 0 where there is none
    std::optional<rays::Hit> surface{};  ///< that it lies on, on the side of the normal
};

/// The place of a measuring point: its own position, unless something other than the surface that it lies on
/// is nearer than kEdgeMargin offsets. Then, of the places around it that are clear of surfaces, one on the
/// surface that the point lies on, if there is one, where most is in sight. The insides of closed bodies
/// without light do not count as sight.
Place place_of(const MeasuringPoint& point, const rays::RayCaster& caster);

/// The place of a small body. One that lies on a surface lies on the side that its axis points to, or on the
/// front where the axis lies in the surface, which then hides half of the sphere from it.
Place place_of(const BodyPoint& body, const rays::RayCaster& caster);

/// A hit that is seen from `eye`, moved likewise to where the eye sees it.
rays::Hit clear_of_walls(const rays::Hit& hit, const Vec3& eye, const rays::RayCaster& caster);

}  // namespace stilb::sensors
