// Sobolev's problem as a scene: finite planes stand in for the infinite ones.
#pragma once

#include "exact/sobolev.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::verification {

/// The share of the exact illuminance by which the finite planes' may fall short, at most.
inline constexpr double kLargestTruncation = 2e-4;

/// Plane 1 is z = 0 and plane 2 above it; the source is on the z axis. `largest_radius_m`: up to there the
/// planes' finite size costs less than kLargestTruncation of the illuminance on either plane.
Scene make_sobolev_scene(const exact::ParallelPlanes& planes, double largest_radius_m);

/// The point of a plane at `radius_m` from the axis, in the direction of the azimuth.
MeasuringPoint sobolev_point(const exact::ParallelPlanes& planes, exact::Plane plane, double radius_m,
                             double azimuth_rad);

}  // namespace stilb::verification
