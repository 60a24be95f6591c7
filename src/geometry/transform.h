// Affine transforms of objects.
#pragma once

#include "geometry/shape.h"

namespace stilb::geometry {

/// p -> x_axis p.x + y_axis p.y + z_axis p.z + translation.
struct Transform {
    Vec3 x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};
    Vec3 translation;

    bool operator==(const Transform&) const = default;

    static Transform scaling(double factor);
    /// Right-handed about `unit_axis` through the origin.
    static Transform rotation(const Vec3& unit_axis, double angle_deg);

    Vec3 direction(const Vec3& d) const { return d.x * x_axis + d.y * y_axis + d.z * z_axis; }
    /// The unit normal of the transformed surface, on the same side of it; zero stays zero.
    Vec3 normal(const Vec3& n) const;
    Vec3 point(const Vec3& p) const { return direction(p) + translation; }
    /// Volumes are multiplied by this; negative for mirrored transforms.
    double determinant() const { return dot(x_axis, cross(y_axis, z_axis)); }
    /// |determinant| over the product of the axes' lengths, 0 to 1; 0 for a singular transform.
    double regularity() const;
    /// Whether angles and ratios of lengths are preserved.
    bool is_similarity() const;
};

/// First `first`, then `second`.
Transform compose(const Transform& second, const Transform& first);

/// The transformed shape; fronts stay fronts under mirrored transforms. Boxes become meshes unless their axes
/// stay axis-parallel. Precondition for spheres, disks and harmonics: the transform is a similarity.
Shape transformed(Shape shape, const Transform& transform);

}  // namespace stilb::geometry
