// Sampling of emitters by the solid angle that they subtend at a point, from either side. Limits:
// docs/materials.md. Very small solid angles are sampled by area instead (density d^2 / (cos A), unbiased
// too).
#pragma once

#include <array>
#include <optional>

#include "geometry/shape.h"
#include "math/sampling.h"

namespace stilb::lights {

/// A point of an emitter, seen from a given point. pdf_per_sr is the density of the direction towards it.
struct SolidAngleSample {
    Vec3 point;
    double pdf_per_sr = 0;
};

/// Sampling of the cone of tangents; nothing where `from` lies in or on the sphere. [LocalEstimation
/// (11)-(14)]
std::optional<SolidAngleSample> sample_by_solid_angle(const Sphere& sphere, const Vec3& from, double u1,
                                                      double u2);
/// Spherical rectangle [Urena et al. 2013] for right angles, otherwise two spherical triangles.
/// Nothing where the solid angle is 0 (seen edge-on).
std::optional<SolidAngleSample> sample_by_solid_angle(const Rectangle& rectangle, const Vec3& from, double u1,
                                                      double u2);
/// Spherical triangle [Arvo 1995].
std::optional<SolidAngleSample> sample_by_solid_angle(const std::array<Vec3, 3>& triangle, const Vec3& from,
                                                      double u1, double u2);
/// Through the spherical rectangle of the disk's square; nothing edge-on or where the square's corner is met:
/// such a sample counts as 0.
std::optional<SolidAngleSample> sample_by_solid_angle(const Disk& disk, const Vec3& from, double u1,
                                                      double u2);

}  // namespace stilb::lights
