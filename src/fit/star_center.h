// Centres of star-shaped meshes: every ray from such a point meets the mesh once.
#pragma once

#include <span>

#include "base/vec.h"
#include "fit/star_survey.h"

namespace stilb::fit {

struct StarCenter {
    Vec3 center;
    /// The distance of the planes of all faces from the centre that maximises it; 0 or below: no point sees
    /// all faces from their front, and `center` was searched for instead.
    double margin = 0;
};

/// Bounds of the vertices that faces use (bounds_of() includes unused ones).
Bounds bounds_of_faces(const Mesh& mesh);

/// The average number of surplus or missing crossings of the surface over all directions from a point: 0
/// where each direction meets it once. By solid angles: those of faces seen from behind, and the deviation of
/// the sum of all (positive from the front, negative from behind) from 4 pi. Fronts are outside.
double superfluous_crossings(const Mesh& mesh, const Vec3& from);

/// The middle of the largest ball of points that see all faces from their front (the kernel, if the mesh is
/// closed and of one part). Where there is no such point, the one with the fewest surplus crossings, at
/// least a tenth of the size away from the surface; among those with a thousandth of a crossing or less, the
/// one farthest from the surface. The search covers the bounding box, from the middle of the
/// volume and from that of the ball. Fronts are outside; `caster` belongs to the same mesh.
StarCenter find_star_center(const Mesh& mesh, const RadialCaster& caster);

// The largest ball behind planes: a linear programme for its centre and radius.

/// The points x with dot(normal, x) <= offset; `normal` is a unit vector.
struct HalfSpace {
    Vec3 normal;
    double offset = 0;
};

/// `radius` may be negative: then no point is behind all planes, and the centre is the one that minimises the
/// distance before any of them.
struct InnerBall {
    Vec3 center;
    double radius = 0;
};

/// Maximises radius subject to dot(normal, center) + radius <= offset for all planes. The centre lies
/// within `reach` of the origin, or little farther where the planes leave it unbounded. The radius is exact
/// for the centre, and maximal up to 1e-6 of `reach`.
InnerBall largest_ball(std::span<const HalfSpace> walls, double reach);

}  // namespace stilb::fit
