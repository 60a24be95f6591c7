#include "geometry/transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/shape.h"

namespace stilb::geometry {
namespace {

/// The factor by which a similarity multiplies lengths.
double similarity_scale(const Transform& t) { return std::cbrt(std::abs(t.determinant())); }

bool keeps_axes(const Transform& t) {
    return t.x_axis.y == 0 && t.x_axis.z == 0 && t.y_axis.x == 0 && t.y_axis.z == 0 && t.z_axis.x == 0 &&
           t.z_axis.y == 0;
}

Shape moved(Mesh mesh, const Transform& t) {
    for (Vec3& vertex : mesh.vertices) vertex = t.point(vertex);
    for (Vec3& normal : mesh.normals) normal = t.normal(normal);
    if (t.is_mirrored()) {
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) turn_over(mesh, i);
    }
    return mesh;
}

Shape moved(const Instance& instance, const Transform& t) {
    return Instance{instance.mesh, compose(t, instance.to_world)};
}

Shape moved(const Rectangle& r, const Transform& t) {
    Rectangle result{t.point(r.corner), t.direction(r.edge_u), t.direction(r.edge_v)};
    if (t.is_mirrored()) std::swap(result.edge_u, result.edge_v);
    return result;
}

Shape moved(const Box& box, const Transform& t) {
    if (!keeps_axes(t)) return moved(triangulated(box), t);
    const Vec3 a = t.point(box.min), b = t.point(box.max);
    return Box{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
               {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

Shape moved(const Sphere& s, const Transform& t) {
    return Sphere{t.point(s.center), s.radius * similarity_scale(t)};
}

Shape moved(const Disk& d, const Transform& t) {
    return Disk{t.point(d.center), normalized(t.direction(d.normal)), d.radius * similarity_scale(t)};
}

Shape moved(const Harmonics& h, const Transform& t) {
    const double scale = similarity_scale(t);
    const auto turned = [&](const Vec3& axis) { return t.direction(axis) / scale; };
    Harmonics result = h;
    result.center = t.point(h.center);
    result.scale *= scale;
    result.axes = {turned(h.axes.u), turned(h.axes.v), turned(h.axes.w)};
    return result;
}

}  // namespace

Transform Transform::scaling(double factor) { return {{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}, {}}; }

Transform Transform::rotation(const Vec3& unit_axis, double angle_deg) {
    const double angle = angle_deg * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](const Vec3& v) {
        return c * v + s * cross(unit_axis, v) + (1 - c) * dot(unit_axis, v) * unit_axis;
    };
    return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}

Vec3 Transform::normal(const Vec3& n) const {
    // By the inverse transpose, up to a positive factor: the cofactors, whose sign is the determinant's.
    const Vec3 moved =
        n.x * cross(y_axis, z_axis) + n.y * cross(z_axis, x_axis) + n.z * cross(x_axis, y_axis);
    const double size = length(moved);
    return size > 0 ? moved / std::copysign(size, determinant()) : Vec3{};
}

Transform Transform::inverse() const {
    // The rows of the inverse matrix are the cofactors of the columns over the determinant.
    const double d = determinant();
    const Vec3 x = cross(y_axis, z_axis) / d, y = cross(z_axis, x_axis) / d, z = cross(x_axis, y_axis) / d;
    Transform inverse{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}, {}};
    inverse.translation = -inverse.direction(translation);
    return inverse;
}

double Transform::regularity() const {
    const double volume = length(x_axis) * length(y_axis) * length(z_axis);
    return volume > 0 ? std::abs(determinant()) / volume : 0;
}

bool Transform::is_similarity() const {
    constexpr double tolerance = 1e-6;
    const double x = length(x_axis), y = length(y_axis), z = length(z_axis);
    return std::abs(x - y) <= tolerance * x && std::abs(x - z) <= tolerance * x &&
           regularity() >= 1 - tolerance;
}

Transform compose(const Transform& second, const Transform& first) {
    return {second.direction(first.x_axis), second.direction(first.y_axis), second.direction(first.z_axis),
            second.point(first.translation)};
}

Shape transformed(Shape shape, const Transform& transform) {
    return std::visit([&](auto& s) { return moved(std::move(s), transform); }, shape);
}

Mesh triangulated(const Instance& instance) {
    return std::get<Mesh>(moved(*instance.mesh, instance.to_world));
}

}  // namespace stilb::geometry
