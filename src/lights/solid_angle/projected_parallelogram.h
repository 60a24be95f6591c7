// Points of a parallelogram by projected solid angle, along its edges: parts of it that are bounded by lines
// parallel to an edge, as shadows of furniture often are, take even shares of low-discrepancy points.
#pragma once

#include "geometry/shape.h"

namespace stilb::lights {

/// A parallelogram above the horizon of an element at the origin, whose normal is the z axis.
class ProjectedParallelogram {
  public:
    /// Precondition: all corners are above the horizon, and the front is seen.
    ProjectedParallelogram(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v);

    double projected_solid_angle_sr() const { return whole_sr_; }
    /// Shares of the edges from the corner: the first by the projected solid angle of the strip before it,
    /// the second by that of the line through it. Both by Newton's method.
    struct Shares {
        double u = 0, v = 0;
    };
    Shares sample(double u1, double u2) const;

  private:
    class Line;

    /// Of the strip from the corner to a share of edge u.
    double strip_sr(double share) const;
    Vec3 start(double share) const { return corner_ + share * edge_u_; }

    Vec3 corner_, edge_u_, edge_v_;
    double height_m_ = 0;  ///< of the element over the parallelogram's plane
    double area_m2_ = 0;
    double first_side_sr_ = 0;       ///< twice the term of Lambert's formula of the edge at the corner
    Vec3 near_normal_, far_normal_;  ///< of the planes through the edges along u
    double whole_sr_ = 0;
};

}  // namespace stilb::lights
