#include "exact/configuration_factors.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "exact/domain.h"

namespace stilb::exact {
namespace {

using std::numbers::pi;

Vec3 require_receiver(const Receiver& receiver) {
    require(is_finite(receiver.position), "receiver: the position is not finite");
    return require_direction(receiver.normal, "receiver: the normal is zero or not finite");
}

void require_luminance(double luminance_cd_m2) {
    require_not_negative(luminance_cd_m2, "light: the luminance is negative or not finite");
}

/// One edge's share of Lambert's contour sum, seen from the origin: its angle times the sine of the angle
/// between its plane and the receiver's normal.
double edge_term(const Vec3& from, const Vec3& to, const Vec3& normal) {
    const Vec3 across = cross(from, to);
    const double sine = length(across);
    if (sine == 0) return 0;  // seen end-on
    return std::atan2(sine, dot(from, to)) * dot(across, normal) / sine;
}

/// The part of a closed line of vertices above the plane through the origin with this normal [Sutherland and
/// Hodgman]. Where a concave polygon falls apart, its pieces are joined along the plane, there and back.
std::vector<Vec3> clipped_at_horizon(const std::vector<Vec3>& vertices, const Vec3& normal) {
    std::vector<Vec3> above;
    Vec3 from = vertices.back();
    for (const Vec3& to : vertices) {
        const double from_height = dot(from, normal), to_height = dot(to, normal);
        if ((from_height > 0) != (to_height > 0))
            above.push_back((from_height * to - to_height * from) / (from_height - to_height));
        if (to_height > 0) above.push_back(to);
        from = to;
    }
    return above;
}

/// Twice the vector area.
Vec3 doubled_area(const std::vector<Vec3>& vertices) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
        sum += cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
    return sum;
}

/// The unit normal of a polygon; refuses what is not a plane polygon.
Vec3 require_plane_polygon(const std::vector<Vec3>& vertices) {
    require(vertices.size() >= 3, "polygon: there are fewer than three vertices");
    double size_m = 0;
    for (const Vec3& vertex : vertices) size_m = std::max(size_m, length(vertex - vertices[0]));
    require_positive(size_m, "polygon: its vertices are one point or not finite");
    const Vec3 area = doubled_area(vertices);
    require(length(area) > 1e-12 * size_m * size_m, "polygon: it has no area");
    const Vec3 normal = normalized(area);
    for (const Vec3& vertex : vertices)
        require(std::abs(dot(vertex - vertices[0], normal)) <= 1e-9 * size_m, "polygon: it is not plane");
    return normal;
}

/// A circle seen from the origin, center + radius (cos(a) u + sin(a) v), with v at right angles to the
/// center. Its normal u x v points away from the origin.
struct Circle {
    Vec3 center, u, v;
    double radius;

    Vec3 at(double angle) const { return center + radius * (std::cos(angle) * u + std::sin(angle) * v); }
};

Circle circle_seen_from_origin(const Vec3& center, const Vec3& unit_normal, double radius) {
    const auto flattened = [&](const Vec3& a) { return a - dot(a, unit_normal) * unit_normal; };
    const Vec3 off_axis = flattened(flattened(center));  // twice, as the first leaves a rounding error
    const double offset = length(off_axis);
    const bool on_axis = offset <= 1e-15 * length(center);
    const Vec3 u = on_axis ? Frame::around(unit_normal).u : off_axis / offset;
    return {center, u, cross(unit_normal, u), radius};
}

/// The primitive, continuous in `angle`, of 1 / (a + b cos(angle)), given a - b and a + b, both positive.
double primitive_of_reciprocal(double a_minus_b, double a_plus_b, double angle) {
    const double turns = std::round(angle / (2 * pi));
    const double half = angle / 2 - pi * turns;
    const double bent =
        std::atan2(std::sqrt(a_minus_b) * std::sin(half), std::sqrt(a_plus_b) * std::cos(half));
    return 2 * (bent + pi * turns) / std::sqrt(a_minus_b * a_plus_b);
}

/// The contour integral of (x cross dx) . normal / |x|^2 along an arc, the limit of the sum of edge_term().
/// With x2 = a + b cos the numerator is alpha + beta cos + gamma sin, which has an elementary primitive.
double arc_term(const Circle& circle, double from, double to, const Vec3& normal) {
    const double r = circle.radius;
    const Vec3& c = circle.center;
    const double offset = dot(c, circle.u);
    const double depth = dot(c, cross(circle.u, circle.v));
    const double a = squared_length(c) + r * r, b = 2 * r * offset;
    const double alpha = r * r * dot(cross(circle.u, circle.v), normal);
    const double beta = r * dot(cross(c, circle.v), normal);
    const double gamma = -r * dot(cross(c, circle.u), normal);
    if (std::abs(b) < 0.3 * a) {  // the primitive cancels, but the integrand is smooth
        return boost::math::quadrature::gauss<double, 40>::integrate(
            [&](double angle) {
                const double cosine = std::cos(angle);
                return (alpha + beta * cosine + gamma * std::sin(angle)) / (a + b * cosine);
            },
            from, to);
    }
    const double a_minus_b = (offset - r) * (offset - r) + depth * depth;
    const double a_plus_b = (offset + r) * (offset + r) + depth * depth;
    const double reciprocal =
        primitive_of_reciprocal(a_minus_b, a_plus_b, to) - primitive_of_reciprocal(a_minus_b, a_plus_b, from);
    const double logarithm = std::log(squared_length(circle.at(to)) / squared_length(circle.at(from)));
    return (alpha - beta * a / b) * reciprocal + (beta * (to - from) - gamma * logarithm) / b;
}

}  // namespace

double illuminance_by_point_lx(const Receiver& receiver, const Vec3& source, double intensity_cd) {
    const Vec3 normal = require_receiver(receiver);
    require_not_negative(intensity_cd, "light: the intensity is negative or not finite");
    const Vec3 to_source = source - receiver.position;
    const double distance_m = length(to_source);
    require_positive(distance_m, "point source: it is at the receiver or not finite");
    const double cosine = std::max(0.0, dot(to_source, normal) / distance_m);
    return intensity_cd * cosine / (distance_m * distance_m);
}

double illuminance_by_polygon_lx(const Receiver& receiver, std::span<const Vec3> vertices,
                                 double luminance_cd_m2) {
    const Vec3 normal = require_receiver(receiver);
    require_luminance(luminance_cd_m2);
    std::vector<Vec3> seen(vertices.begin(), vertices.end());
    for (Vec3& vertex : seen) vertex -= receiver.position;
    const Vec3 front = require_plane_polygon(seen);
    if (dot(seen[0], front) >= 0) return 0;  // seen from behind
    seen = clipped_at_horizon(seen, normal);
    if (seen.empty()) return 0;
    double sum = 0;
    Vec3 from = seen.back();
    for (const Vec3& to : seen) {
        sum -= edge_term(from, to, normal);  // counterclockwise for the front is clockwise for the receiver
        from = to;
    }
    return luminance_cd_m2 * std::max(0.0, sum / 2);
}

double illuminance_by_rectangle_lx(const Receiver& receiver, const Vec3& corner, const Vec3& edge_u,
                                   const Vec3& edge_v, double luminance_cd_m2) {
    const std::array<Vec3, 4> vertices{corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
    return illuminance_by_polygon_lx(receiver, vertices, luminance_cd_m2);
}

double illuminance_by_disk_lx(const Receiver& receiver, const DiskPosition& disk, double luminance_cd_m2) {
    const Vec3 normal = require_receiver(receiver);
    require_luminance(luminance_cd_m2);
    require_positive(disk.radius_m, "disk: the radius is not positive and finite");
    require(is_finite(disk.center), "disk: the center is not finite");
    const Vec3 front = require_direction(disk.normal, "disk: the normal is zero or not finite");
    const Vec3 center = disk.center - receiver.position;
    if (dot(center, front) >= 0) return 0;  // seen from behind
    const Circle rim = circle_seen_from_origin(center, -front, disk.radius_m);

    // Along the rim the height above the horizon is middle + swing cos(angle - top).
    const double middle = dot(center, normal);
    const double along_u = disk.radius_m * dot(rim.u, normal), along_v = disk.radius_m * dot(rim.v, normal);
    const double swing = std::hypot(along_u, along_v);
    if (middle <= -swing) return 0;
    if (middle >= swing) return luminance_cd_m2 / 2 * std::max(0.0, arc_term(rim, -pi, pi, normal));
    const double top = std::atan2(along_v, along_u);
    const double half_arc = std::acos(-middle / swing);
    const double from = top - half_arc, to = top + half_arc;
    const double sum = arc_term(rim, from, to, normal) + edge_term(rim.at(to), rim.at(from), normal);
    return luminance_cd_m2 * std::max(0.0, sum / 2);
}

double illuminance_by_sphere_lx(const Receiver& receiver, const Vec3& center, double radius_m,
                                double luminance_cd_m2) {
    const Vec3 normal = require_receiver(receiver);
    require_luminance(luminance_cd_m2);
    require_positive(radius_m, "sphere: the radius is not positive and finite");
    const Vec3 to_center = center - receiver.position;
    const double distance_m = length(to_center);
    require(distance_m > radius_m && std::isfinite(distance_m),
            "sphere: the receiver is not outside of it or the center is not finite");

    const double sine = radius_m / distance_m;  // of the half angle of the cone that the sphere fills
    const double cosine = std::sqrt((1 - sine) * (1 + sine));
    const double tilt_cosine = dot(to_center, normal) / distance_m;
    const double tilt_sine = length(cross(to_center, normal)) / distance_m;
    if (tilt_cosine <= -sine) return 0;
    if (tilt_cosine >= sine) return luminance_cd_m2 * pi * sine * sine * tilt_cosine;
    // The half arc of the cone's rim above the horizon, and half the angle that the cone cuts out of the
    // horizon.
    const double rim = std::acos(std::clamp(-cosine * tilt_cosine / (sine * tilt_sine), -1.0, 1.0));
    const double chord =
        std::atan2(sine * std::sin(rim), cosine * tilt_sine - sine * tilt_cosine * std::cos(rim));
    return luminance_cd_m2 *
           std::max(0.0, rim * sine * sine * tilt_cosine - sine * cosine * tilt_sine * std::sin(rim) + chord);
}

}  // namespace stilb::exact
