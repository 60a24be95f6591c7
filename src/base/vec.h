// Vectors in three dimensions, in double precision; single precision exists only inside the ray caster.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace stilb {

inline constexpr double kPi = std::numbers::pi;

struct Vec3 {
    double x = 0, y = 0, z = 0;

    constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr Vec3 operator-() const { return {-x, -y, -z}; }
    constexpr Vec3& operator+=(const Vec3& b) { return *this = {x + b.x, y + b.y, z + b.z}; }
    constexpr Vec3& operator-=(const Vec3& b) { return *this = {x - b.x, y - b.y, z - b.z}; }
    constexpr bool operator==(const Vec3&) const = default;
};

constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator*(const Vec3& a, double s) { return s * a; }
constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }

constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double squared_length(const Vec3& a) { return dot(a, a); }
inline double length(const Vec3& a) { return std::sqrt(squared_length(a)); }
/// a / |a|; precondition: a is not zero.
inline Vec3 normalized(const Vec3& a) { return a / length(a); }
inline bool is_finite(const Vec3& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
/// `direction` reflected at a plane with unit normal `normal`; both point away from the surface.
constexpr Vec3 reflected(const Vec3& direction, const Vec3& normal) {
    return 2 * dot(direction, normal) * normal - direction;
}

/// A right-handed orthonormal basis whose w axis is a given unit vector.
struct Frame {
    Vec3 u, v, w;

    /// [Duff et al. 2017, Building an orthonormal basis, revisited]: no singular direction.
    static Frame around(const Vec3& unit_w) {
        const double sign = std::copysign(1.0, unit_w.z);
        const double a = -1 / (sign + unit_w.z);
        const double b = unit_w.x * unit_w.y * a;
        return {{1 + sign * unit_w.x * unit_w.x * a, sign * b, -sign * unit_w.x},
                {b, sign + unit_w.y * unit_w.y * a, -unit_w.y},
                unit_w};
    }
    /// The frame of a surface for anisotropic materials: u is horizontal and, seen from the
    /// normal's side, points to the right of the upward direction v; where the normal is vertical (within
    /// 1e-5), u is the x axis.
    static Frame of_surface(const Vec3& unit_normal) {
        const Vec3& n = unit_normal;
        const double horizontal = std::sqrt(n.x * n.x + n.y * n.y);
        const Vec3 u = horizontal > 1e-5 ? Vec3{-n.y / horizontal, n.x / horizontal, 0}
                                         : normalized(Vec3{1, 0, 0} - n.x * n);
        return {u, cross(n, u), n};
    }
    Vec3 to_world(const Vec3& local) const { return local.x * u + local.y * v + local.z * w; }
    Vec3 to_local(const Vec3& world) const { return {dot(world, u), dot(world, v), dot(world, w)}; }
};

/// The largest of the components' magnitudes.
inline double largest_coordinate(const Vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Axis-parallel bounding boxes.

struct Bounds {
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vec3 min{kInfinity, kInfinity, kInfinity};
    Vec3 max{-kInfinity, -kInfinity, -kInfinity};

    constexpr bool is_empty() const { return min.x > max.x; }
    /// Half of the longest edge; 0 where there is nothing.
    constexpr double half_extent() const {
        return is_empty() ? 0 : std::max({max.x - min.x, max.y - min.y, max.z - min.z}) / 2;
    }
    constexpr Vec3 middle() const { return 0.5 * (min + max); }
    /// The area of the six faces.
    constexpr double surface_m2() const {
        const Vec3 e = max - min;
        return 2 * (e.y * e.z + e.z * e.x + e.x * e.y);
    }
    constexpr void include(const Vec3& p) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
    }
};

}  // namespace stilb
