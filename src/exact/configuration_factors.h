// The illuminance of a tilted element by one unoccluded light of simple shape, in closed form.
//
// Lights are uniform: of the same luminance in all directions and at all points. What lies below the
// element's horizon is cut off exactly. Errors are stated relative to pi times the luminance, which is the
// largest illuminance that this luminance can give. All functions throw std::domain_error on arguments out of
// range.
#pragma once

#include <span>

#include "base/vec.h"

namespace stilb::exact {

/// A surface element that light falls on. The normal may have any length but zero.
struct Receiver {
    Vec3 position, normal;
};

/// By an isotropic point source: I cos+ / d2. Relative error below 1e-14; not at the source itself.
double illuminance_by_point_lx(const Receiver& receiver, const Vec3& source, double intensity_cd);

/// By a plane polygon, convex or not, that emits to the side from which its vertices run
/// counterclockwise (Lambert's formula); nothing comes from behind or in the plane itself. Error below 1e-14;
/// refuses fewer than three vertices, no area, and vertices farther than 1e-9 of its size from one plane.
double illuminance_by_polygon_lx(const Receiver& receiver, std::span<const Vec3> vertices,
                                 double luminance_cd_m2);

/// By the parallelogram corner + s edge_u + t edge_v, 0 <= s, t <= 1, that emits to the side of edge_u x
/// edge_v.
double illuminance_by_rectangle_lx(const Receiver& receiver, const Vec3& corner, const Vec3& edge_u,
                                   const Vec3& edge_v, double luminance_cd_m2);

/// The position of a disk. Its normal may have any length but zero and points to the side that emits.
struct DiskPosition {
    Vec3 center, normal;
    double radius_m = 1;
};

/// By a disk anywhere to an element of any tilt. Error below 1e-13, and below 1e-15 radius / d where the
/// receiver is at a small distance d from the rim.
double illuminance_by_disk_lx(const Receiver& receiver, const DiskPosition& disk, double luminance_cd_m2);

/// By a sphere, wholly or partly above the element's horizon. Error below 1e-14; the receiver is outside.
double illuminance_by_sphere_lx(const Receiver& receiver, const Vec3& center, double radius_m,
                                double luminance_cd_m2);

}  // namespace stilb::exact
