// Shapes that rays are intersected with exactly, in double precision, instead of through triangles.
#pragma once

#include <optional>
#include <variant>

#include "scene/bounds.h"
#include "scene/shape.h"

namespace stilb {

using AnalyticShape = std::variant<Sphere, Disk>;

/// The points origin + t direction, start < t < end; the direction need not be a unit vector.
struct RayInterval {
    Vec3 origin, direction;
    double start = 0, end = 0;
};

/// A point of the surface with the unit normal of its front; `size_m` bounds the shape's extent.
struct SurfacePoint {
    Vec3 position, normal;
    double size_m = 0;
};

Bounds bounds_of(const AnalyticShape& shape);
/// Smallest t in the interval at which the ray meets the surface, from either side.
std::optional<double> intersect(const AnalyticShape& shape, const RayInterval& ray);
/// `near_by` (a hit with the rounding error of single precision) projected onto the surface.
SurfacePoint nearest_surface_point(const AnalyticShape& shape, const Vec3& near_by);

}  // namespace stilb
