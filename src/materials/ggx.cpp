#include "materials/ggx.h"

#include <algorithm>

namespace stilb::materials {

Vec3 Ggx::visible_normal(const Vec3& in, const math::DiskPoint& point) const {
    // On the hemisphere that the facets become when the surface is stretched by 1/alpha, a visible normal is
    // a point of the hemisphere's projection along the stretched direction.
    const Vec3 view = normalized(Vec3{alpha_ * in.x, alpha_ * in.y, in.z});
    const double across = std::hypot(view.x, view.y);
    const Vec3 t1 = across > 0 ? Vec3{-view.y / across, view.x / across, 0} : Vec3{1, 0, 0};
    const Vec3 t2 = cross(view, t1);
    const double share = (1 + view.z) / 2;
    const double half_chord = std::sqrt(std::max(0.0, 1 - point.x * point.x));
    const double y = (1 - share) * half_chord + share * point.y;
    const double z = std::sqrt(std::max(0.0, 1 - point.x * point.x - y * y));
    const Vec3 normal = point.x * t1 + y * t2 + z * view;
    return normalized(Vec3{alpha_ * normal.x, alpha_ * normal.y, std::max(normal.z, 1e-12)});
}

}  // namespace stilb::materials
