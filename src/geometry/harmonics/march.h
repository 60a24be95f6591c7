// The first crossing of a ray and a surface by spherical harmonics as in [LocalEstimation 5]: steps along the
// ray until the side changes, then halving. For comparison: what lies within one step is missed
// (HarmonicSurface::first_crossing() misses nothing).
#pragma once

#include <optional>

#include "geometry/harmonics/surface.h"

namespace stilb::geometry {

/// A step's length as a share of the greatest radius. The paper states none.
inline constexpr double kMarchedShare = 0.02;

/// Between two distances along a unit direction, in equal steps from where the ray enters the sphere that
/// holds the surface (or from `start`); halved until rounding ends it.
std::optional<HarmonicCrossing> march_crossing(const HarmonicSurface& surface, const Vec3& origin,
                                               const Vec3& direction, double start, double end, double step);

}  // namespace stilb::geometry
