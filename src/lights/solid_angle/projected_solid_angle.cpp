#include "lights/solid_angle/projected_solid_angle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "lights/solid_angle/projected_parallelogram.h"
#include "lights/solid_angle/seen_polygon.h"
#include "math/gauss_legendre.h"
#include "math/sampling.h"

namespace stilb::lights {
namespace {

/// A point nearer to an emitter's plane than this share of its distance counts as in the plane.
constexpr double kInPlane = 1e-12;

// Polygons.

/// Whether a point sees the front of a flat element.
bool sees_front(const Vec3& to_point, const Vec3& normal) {
    return dot(to_point, normal) < -kInPlane * length(to_point);
}

SeenPolygon seen(const Rectangle& r, const SurfacePoint& at, const Frame& frame) {
    // The front's order, reversed: from the receiver's side.
    const Vec3 corner = frame.to_local(r.corner - at.position);
    const Vec3 u = frame.to_local(r.edge_u), v = frame.to_local(r.edge_v);
    return SeenPolygon(std::array{corner, corner + v, corner + u + v, corner + u});
}
SeenPolygon seen(const std::array<Vec3, 3>& t, const SurfacePoint& at, const Frame& frame) {
    return SeenPolygon(std::array{frame.to_local(t[0] - at.position), frame.to_local(t[2] - at.position),
                                  frame.to_local(t[1] - at.position)});
}

const Vec3& corner_of(const Rectangle& r) { return r.corner; }
const Vec3& corner_of(const std::array<Vec3, 3>& t) { return t[0]; }

template <typename Polygon>
double polygon_sr(const Polygon& polygon, const Vec3& normal, const SurfacePoint& at) {
    if (!sees_front(corner_of(polygon) - at.position, normal)) return 0;
    return seen(polygon, at, Frame::around(at.normal)).projected_solid_angle_sr();
}

/// The point where a ray from `from` meets the plane through `corner`.
Vec3 in_plane(const Vec3& from, const Vec3& direction, const Vec3& corner, const Vec3& normal) {
    return from + dot(corner - from, normal) / dot(direction, normal) * direction;
}

template <typename Polygon>
std::optional<ProjectedSample> sample_polygon(const Polygon& polygon, const Vec3& normal,
                                              const SurfacePoint& at, math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    if (!sees_front(corner_of(polygon) - at.position, normal)) return std::nullopt;
    const Frame frame = Frame::around(at.normal);
    const SeenPolygon projection = seen(polygon, at, frame);
    const auto direction = projection.sample(u1, u2);
    if (!direction) return std::nullopt;
    const Vec3 point = in_plane(at.position, frame.to_world(*direction), corner_of(polygon), normal);
    return ProjectedSample{{point, normal}, projection.projected_solid_angle_sr()};
}

std::optional<ProjectedSample> sample_flat(const std::array<Vec3, 3>& triangle, const Vec3& normal,
                                           const SurfacePoint& at, math::SampleStream& stream) {
    return sample_polygon(triangle, normal, at, stream);
}

/// Along the edges where all of it is above the horizon.
std::optional<ProjectedSample> sample_flat(const Rectangle& r, const Vec3& normal, const SurfacePoint& at,
                                           math::SampleStream& stream) {
    const Frame frame = Frame::around(at.normal);
    const Vec3 corner = frame.to_local(r.corner - at.position);
    const Vec3 u = frame.to_local(r.edge_u), v = frame.to_local(r.edge_v);
    const double lowest = corner.z + std::min(0.0, u.z) + std::min(0.0, v.z);
    if (!(lowest > 0) || !sees_front(r.corner - at.position, normal))
        return sample_polygon(r, normal, at, stream);
    const ProjectedParallelogram projection(corner, u, v);
    const auto [u1, u2] = stream.next_two();
    if (!(projection.projected_solid_angle_sr() > 0)) return std::nullopt;
    const auto shares = projection.sample(u1, u2);
    return ProjectedSample{{r.corner + shares.u * r.edge_u + shares.v * r.edge_v, normal},
                           projection.projected_solid_angle_sr()};
}

// Spheres. The cone of directions to a sphere has the half angle `s`, its axis the angle `t` to the normal.

struct SeenSphere {
    double sine_s, cosine_s, sine_t, cosine_t;

    SeenSphere(const Sphere& sphere, const SurfacePoint& at) {
        const Vec3 towards = sphere.center - at.position;
        const double distance = length(towards);
        sine_s = sphere.radius / distance;
        cosine_s =
            std::sqrt(std::max(0.0, (distance - sphere.radius) * (distance + sphere.radius))) / distance;
        cosine_t = dot(towards, at.normal) / distance;
        sine_t = length(cross(towards, at.normal)) / distance;
    }
    bool is_below() const { return cosine_t <= -sine_s; }
    bool is_above() const { return cosine_t >= sine_s; }
    double projected_sr() const {
        if (is_below()) return 0;
        if (is_above()) return kPi * sine_s * sine_s * cosine_t;
        // Half of the cone's rim above the horizon, and half of the angle that the cone takes of the horizon.
        const double rim = std::acos(std::clamp(-cosine_s * cosine_t / (sine_s * sine_t), -1.0, 1.0));
        const double chord =
            std::atan2(sine_s * std::sin(rim), cosine_s * sine_t - sine_s * cosine_t * std::cos(rim));
        return std::max(
            0.0, sine_s * sine_s * cosine_t * rim - sine_s * cosine_s * sine_t * std::sin(rim) + chord);
    }
    bool contains(const Vec3& local) const { return local.x * sine_t + local.z * cosine_t >= cosine_s; }

    /// In a frame whose x axis is the direction of the horizon below or above the sphere.
    Vec3 sample(math::SampleStream& stream) const {
        const auto [u1, u2] = stream.next_two();
        return is_above() ? sample_ellipse(u1, u2) : sample_above_horizon(u1, u2, stream);
    }
    Vec3 sample_ellipse(double u1, double u2) const {
        const math::DiskPoint p = math::sample_unit_disk(u1, u2);
        const double x = sine_t * cosine_s + sine_s * cosine_t * p.x, y = sine_s * p.y;
        return {x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))};
    }
    /// By rejection from the azimuths and squared heights that hold the part above the horizon: a half or
    /// more of all are taken.
    Vec3 sample_above_horizon(double u1, double u2, math::SampleStream& stream) const {
        double most_azimuth = kPi, most_height = 1;
        if (sine_t > sine_s || cosine_t < 0) {
            most_azimuth =
                cosine_t > 0 ? std::asin(sine_s / sine_t) : std::acos(std::min(1.0, cosine_s / sine_t));
            most_height = sine_s * sine_t + cosine_s * cosine_t;
        }
        for (;;) {
            const double azimuth = (2 * u1 - 1) * most_azimuth;
            const double squared = u2 * most_height * most_height;
            const double horizontal = std::sqrt(1 - squared);
            const Vec3 local{horizontal * std::cos(azimuth), horizontal * std::sin(azimuth),
                             std::sqrt(squared)};
            if (contains(local)) return local;
            u1 = stream.next(), u2 = stream.next();
        }
    }
};

/// The point of a sphere that a ray from outside meets first; the rim where rounding lets it pass.
Vec3 on_sphere(const Sphere& sphere, const Vec3& from, const Vec3& direction) {
    const Vec3 towards = sphere.center - from;
    const double along = dot(towards, direction);
    const Vec3 nearest = from + along * direction - sphere.center;
    const double chord = std::sqrt(std::max(0.0, sphere.radius * sphere.radius - squared_length(nearest)));
    return sphere.center + sphere.radius * normalized(nearest - chord * direction);
}

bool is_outside(const Sphere& sphere, const Vec3& point) {
    return squared_length(sphere.center - point) > sphere.radius * sphere.radius;
}

// Disks.

/// The rim of a disk relative to an observer: center + radius (cos a u + sin a v), v at right angles to the
/// center.
struct Rim {
    Vec3 center, u, v;
    double radius;

    Vec3 at(double angle) const { return center + radius * (std::cos(angle) * u + std::sin(angle) * v); }
};

Rim rim_of(const Disk& disk, const Vec3& from) {
    const Vec3 center = disk.center - from;
    const Vec3 axis = -disk.normal;
    const Vec3 aside = center - dot(center, axis) * axis;
    const double offset = length(aside);
    const Vec3 u =
        offset > 1e-12 * length(center) ? normalized(aside - dot(aside, axis) * axis) : Frame::around(axis).u;
    return {center, u, cross(axis, u), disk.radius};
}

/// The angle at which the position along an ellipse-like rim is reached: a primitive of 1 / (a + b cos),
/// times the root of (a - b) (a + b).
double bent_angle(double root_minus, double root_plus, double angle) {
    const double turns = std::round(angle / (2 * kPi));
    const double half = angle / 2 - kPi * turns;
    return 2 * (std::atan2(root_minus * std::sin(half), root_plus * std::cos(half)) + kPi * turns);
}

/// The contour integral of normal . (x cross dx) / |x|^2 along an arc. |x|^2 is a + b cos, and the numerator
/// alpha + beta cos + gamma sin.
double arc_term(const Rim& rim, double from, double to, const Vec3& normal) {
    const double r = rim.radius;
    const Vec3 axis = cross(rim.u, rim.v);
    const double offset = dot(rim.center, rim.u), depth = dot(rim.center, axis);
    const double a = squared_length(rim.center) + r * r, b = 2 * r * offset;
    const double alpha = r * r * dot(axis, normal);
    const double beta = r * dot(cross(rim.center, rim.v), normal);
    const double gamma = -r * dot(cross(rim.center, rim.u), normal);
    constexpr double smooth = 0.3;  // the primitive's terms cancel, but few nodes suffice
    if (std::abs(b) < smooth * a) {
        static const math::GaussLegendre rule = math::gauss_legendre(24);
        double sum = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double angle = (from + to + (to - from) * rule.nodes[i]) / 2;
            sum += rule.weights[i] * (alpha + beta * std::cos(angle) + gamma * std::sin(angle)) /
                   (a + b * std::cos(angle));
        }
        return sum * (to - from) / 2;
    }
    const double root_minus = std::hypot(offset - r, depth), root_plus = std::hypot(offset + r, depth);
    const double bent = bent_angle(root_minus, root_plus, to) - bent_angle(root_minus, root_plus, from);
    const double logarithm = std::log(squared_length(rim.at(to)) / squared_length(rim.at(from)));
    return (alpha - beta * a / b) * bent / (root_minus * root_plus) +
           (beta * (to - from) - gamma * logarithm) / b;
}

double disk_sr(const Disk& disk, const SurfacePoint& at) {
    if (!sees_front(disk.center - at.position, disk.normal)) return 0;
    const Rim rim = rim_of(disk, at.position);
    // Along the rim the height above the horizon is middle + swing cos(angle - top).
    const double middle = dot(rim.center, at.normal);
    const double along_u = rim.radius * dot(rim.u, at.normal), along_v = rim.radius * dot(rim.v, at.normal);
    const double swing = std::hypot(along_u, along_v);
    if (middle <= -swing) return 0;
    if (middle >= swing) return std::max(0.0, arc_term(rim, -kPi, kPi, at.normal) / 2);
    const double top = std::atan2(along_v, along_u), half_arc = std::acos(-middle / swing);
    const double from = top - half_arc, to = top + half_arc;
    // The chord lies in the horizon.
    const Vec3 first = rim.at(from), last = rim.at(to);
    const Vec3 across = cross(last, first);
    const double chord = std::copysign(std::atan2(length(across), dot(last, first)), dot(across, at.normal));
    return std::max(0.0, (arc_term(rim, from, to, at.normal) + chord) / 2);
}

/// By points of the disk's square, until one is in the disk.
std::optional<ProjectedSample> sample_disk(const Disk& disk, const SurfacePoint& at,
                                           math::SampleStream& stream) {
    auto [u1, u2] = stream.next_two();
    const double sr = disk_sr(disk, at);
    if (!(sr > 0)) return std::nullopt;
    const Frame frame = Frame::around(at.normal), own = Frame::around(disk.normal);
    const Rectangle square{disk.center - disk.radius * (own.u + own.v), 2 * disk.radius * own.u,
                           2 * disk.radius * own.v};
    const SeenPolygon projection = seen(square, at, frame);
    constexpr int most_tries = 1000;  // rounding may leave nothing of a sliver
    for (int i = 0; i < most_tries; ++i) {
        const auto direction = projection.sample(u1, u2);
        if (!direction) return std::nullopt;
        const Vec3 point = in_plane(at.position, frame.to_world(*direction), disk.center, disk.normal);
        if (squared_length(point - disk.center) <= disk.radius * disk.radius)
            return ProjectedSample{{point, disk.normal}, sr};
        u1 = stream.next(), u2 = stream.next();
    }
    return std::nullopt;
}

std::optional<ProjectedSample> sample_sphere(const Sphere& sphere, const SurfacePoint& at,
                                             math::SampleStream& stream) {
    if (!is_outside(sphere, at.position)) return std::nullopt;
    const SeenSphere seen(sphere, at);
    const double sr = seen.projected_sr();
    if (!(sr > 0)) return std::nullopt;
    const Vec3 local = seen.sample(stream);
    const Vec3 towards = sphere.center - at.position;
    const Vec3 aside = towards - dot(towards, at.normal) * at.normal;
    const double offset = length(aside);
    const Vec3 x = offset > 1e-12 * length(towards) ? aside / offset : Frame::around(at.normal).u;
    const Vec3 direction = local.x * x + local.y * cross(at.normal, x) + local.z * at.normal;
    const Vec3 point = on_sphere(sphere, at.position, direction);
    return ProjectedSample{{point, normalized(point - sphere.center)}, sr};
}

}  // namespace

bool has_closed_form(const EmitterElement& element) {
    return !std::holds_alternative<Harmonics>(element.shape);
}

double projected_solid_angle_sr(const EmitterElement& element, const SurfacePoint& at) {
    return std::visit(
        [&]<typename S>(const S& shape) -> double {
            if constexpr (std::is_same_v<S, Sphere>) {
                return is_outside(shape, at.position) ? SeenSphere(shape, at).projected_sr() : 0;
            } else if constexpr (std::is_same_v<S, Disk>) {
                return disk_sr(shape, at);
            } else if constexpr (std::is_same_v<S, Harmonics>) {
                return 0;
            } else {
                return polygon_sr(shape, *element.normal, at);
            }
        },
        element.shape);
}

std::optional<ProjectedSample> sample_projected(const EmitterElement& element, const SurfacePoint& at,
                                                math::SampleStream& stream) {
    return std::visit(
        [&]<typename S>(const S& shape) -> std::optional<ProjectedSample> {
            if constexpr (std::is_same_v<S, Sphere>) {
                return sample_sphere(shape, at, stream);
            } else if constexpr (std::is_same_v<S, Disk>) {
                return sample_disk(shape, at, stream);
            } else if constexpr (std::is_same_v<S, Harmonics>) {
                return std::nullopt;
            } else {
                return sample_flat(shape, *element.normal, at, stream);
            }
        },
        element.shape);
}

}  // namespace stilb::lights
