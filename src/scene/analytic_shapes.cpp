#include "scene/analytic_shapes.h"

#include <cmath>

namespace stilb {
namespace {

Bounds bounds(const Sphere& s) {
    const Vec3 r{s.radius, s.radius, s.radius};
    return {s.center - r, s.center + r};
}

Bounds bounds(const Disk& d) {
    // The extent of a circle along an axis is its radius times the sine of the angle between axis and normal.
    const auto extent = [&](double n) { return d.radius * std::sqrt(std::max(0.0, 1 - n * n)); };
    const Vec3 e{extent(d.normal.x), extent(d.normal.y), extent(d.normal.z)};
    return {d.center - e, d.center + e};
}

std::optional<double> intersect_shape(const Sphere& s, const RayInterval& ray) {
    const Vec3 to_origin = ray.origin - s.center;
    const double a = squared_length(ray.direction);
    const double b = dot(to_origin, ray.direction);
    const double c = squared_length(to_origin) - s.radius * s.radius;
    // r2 - |closest approach|2, which does not cancel as b2 - ac does for far origins.
    const Vec3 closest = to_origin - b / a * ray.direction;
    const double discriminant = a * (s.radius * s.radius - squared_length(closest));
    if (discriminant < 0) return std::nullopt;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    double first = q / a;
    double second = q != 0 ? c / q : first;
    if (first > second) std::swap(first, second);
    for (const double t : {first, second}) {
        if (t > ray.start && t < ray.end) return t;
    }
    return std::nullopt;
}

std::optional<double> intersect_shape(const Disk& d, const RayInterval& ray) {
    const double t = dot(d.center - ray.origin, d.normal) / dot(ray.direction, d.normal);
    if (!(t > ray.start && t < ray.end))
        return std::nullopt;  // also where the ray is parallel: t is not a number
    const Vec3 from_center = ray.origin + t * ray.direction - d.center;
    if (squared_length(from_center) > d.radius * d.radius) return std::nullopt;
    return t;
}

SurfacePoint nearest_point(const Sphere& s, const Vec3& near_by) {
    const Vec3 normal = normalized(near_by - s.center);
    return {s.center + s.radius * normal, normal, s.radius};
}

SurfacePoint nearest_point(const Disk& d, const Vec3& near_by) {
    return {near_by - dot(near_by - d.center, d.normal) * d.normal, d.normal, d.radius};
}

}  // namespace

Bounds bounds_of(const AnalyticShape& shape) {
    return std::visit([](const auto& s) { return bounds(s); }, shape);
}

std::optional<double> intersect(const AnalyticShape& shape, const RayInterval& ray) {
    return std::visit([&](const auto& s) { return intersect_shape(s, ray); }, shape);
}

SurfacePoint nearest_surface_point(const AnalyticShape& shape, const Vec3& near_by) {
    return std::visit([&](const auto& s) { return nearest_point(s, near_by); }, shape);
}

}  // namespace stilb
