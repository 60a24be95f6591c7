// Points from which a mesh is star-shaped: rays from there meet it once.
#pragma once

#include <span>

#include "base/vec.h"
#include "fit/star_survey.h"

namespace stilb::fit {

struct StarCenter {
    Vec3 center;
    /// How far the planes of all faces are beyond the centre that has most of it; 0 or below: no point sees
    /// all faces from their front, and `center` was searched instead.
    double margin = 0;
};

/// Of the vertices that faces use (bounds_of() is of all).
Bounds bounds_of_faces(const Mesh& mesh);

/// Over all directions from a point, how many crossings of the surface are too many or missing, on average: 0
/// where each direction meets it once. By solid angles: that of faces seen from behind, and what those of all
/// (from the front positive, from behind negative) lack of 4 pi or exceed it by. Fronts are outside.
double superfluous_crossings(const Mesh& mesh, const Vec3& from);

/// The middle of the largest ball of points that see all faces from their front (the kernel, if the mesh is
/// closed and of one part). Where there is no such point, the one with the fewest superfluous crossings, at
/// least a tenth of the size away from the surface; among those with a thousandth of a crossing or less, the
/// one that is farthest from the surface. It is searched within the bounding box, from the middle of the
/// volume and from that of the ball. Fronts are outside; `caster` is that of the same mesh.
StarCenter find_star_center(const Mesh& mesh, const RadialCaster& caster);

// The largest ball behind planes: a linear programme in its centre and radius.

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
