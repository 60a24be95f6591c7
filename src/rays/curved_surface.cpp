#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/harmonics/cells.h"
#include "geometry/harmonics/surface.h"
#include "rays/embree_geometry.h"

namespace stilb::rays {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

NearestPoint nearest_point(const Sphere& s, const Vec3& near_by) {
    const Vec3 normal = normalized(near_by - s.center);
    return {{s.center + s.radius * normal, normal}, s.radius};
}

NearestPoint nearest_point(const Disk& d, const Vec3& near_by) {
    return {{near_by - dot(near_by - d.center, d.normal) * d.normal, d.normal}, d.radius};
}

/// A sphere or a disk.
template <typename Round>
class RoundSurface final : public CurvedSurface {
  public:
    explicit RoundSurface(Round shape) : shape_(shape) {}

    std::size_t part_count() const override { return 1; }
    Bounds bounds_of(std::size_t) const override { return stilb::geometry::bounds_of(Shape{shape_}); }
    double intersect(std::size_t, const RayInterval& ray) const override {
        return intersect_shape(shape_, ray).value_or(kInfinity);
    }
    NearestPoint nearest_point(std::size_t, const Vec3& near_by) const override {
        return rays::nearest_point(shape_, near_by);
    }

  private:
    Round shape_;
};

/// By harmonics, as a whole.
class WholeHarmonics final : public CurvedSurface {
  public:
    explicit WholeHarmonics(Harmonics shape) : shape_(std::move(shape)) {}

    std::size_t part_count() const override { return 1; }
    Bounds bounds_of(std::size_t) const override {
        return stilb::geometry::bounds_of(
            Shape{Sphere{shape_.center, shape_.scale * shape_.surface->greatest_radius()}});
    }
    double intersect(std::size_t, const RayInterval& ray) const override {
        // Distances in the surface's own units, of a unit direction.
        const double length_of_unit = shape_.scale / length(ray.direction);
        const Vec3 origin = shape_.to_own(ray.origin);
        const Vec3 direction = normalized(shape_.axes.to_local(ray.direction));
        const double start = ray.start / length_of_unit, end = ray.end / length_of_unit;
        const auto crossing =
            shape_.method == HarmonicMethod::march
                ? march_crossing(*shape_.surface, origin, direction, start, end,
                                 geometry::kMarchedShare * shape_.surface->greatest_radius())
                : shape_.surface->first_crossing(origin, direction, start, end);
        if (!crossing) return kInfinity;
        return crossing->distance * length_of_unit;
    }
    NearestPoint nearest_point(std::size_t, const Vec3& near_by) const override {
        const Vec3 direction = near_by - shape_.center;
        return {{shape_.point_towards(direction), shape_.normal_towards(direction)}, length(direction)};
    }

  private:
    Harmonics shape_;
};

class HarmonicsInCells final : public CurvedSurface {
  public:
    explicit HarmonicsInCells(Harmonics shape) : shape_(std::move(shape)), cells_(*shape_.cells) {
        const double per_unit = 1 / shape_.scale;
        to_own_ = {per_unit * shape_.axes.u, per_unit * shape_.axes.v, per_unit * shape_.axes.w};
        const auto to_float = [](const Vec3& v) {
            return std::array{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        };
        in_packets_.axes = {to_float(to_own_.u), to_float(to_own_.v), to_float(to_own_.w)};
        in_packets_.center = to_float(shape_.center);
    }

    std::size_t part_count() const override { return cells_.count(); }
    Bounds bounds_of(std::size_t part) const override {
        const Bounds own = cells_.bounds_of(part);
        Bounds bounds;
        for (unsigned corner = 0; corner < 8; ++corner) {
            bounds.include(
                shape_.to_world({corner & 1 ? own.max.x : own.min.x, corner & 2 ? own.max.y : own.min.y,
                                 corner & 4 ? own.max.z : own.min.z}));
        }
        return bounds;
    }
    double intersect(std::size_t part, const RayInterval& ray) const override {
        return cells_.crossing(part, to_own_.to_local(ray.origin - shape_.center),
                               to_own_.to_local(ray.direction), ray.start, ray.end);
    }
    bool has_classifications() const override { return true; }
    LaneClassifications classifications(std::size_t part, const RayPacket& rays) const override {
        return cells_.classifications(part, rays, in_packets_);
    }
    NearestPoint nearest_point(std::size_t part, const Vec3& near_by) const override {
        const auto [position, normal] = cells_.point_at(part, shape_.to_own(near_by));
        return {{shape_.to_world(position), shape_.axes.to_world(normal)}, shape_.scale * length(position)};
    }

  private:
    Harmonics shape_;
    const geometry::HarmonicCells& cells_;  ///< the shape's
    Frame to_own_;                          ///< axes over scale
    PacketPlacement in_packets_;            ///< the same
};

struct Maker {
    using Made = std::unique_ptr<CurvedSurface>;
    const Vec3& origin;

    Made operator()(const Mesh&) const { return nullptr; }
    Made operator()(const Instance&) const { return nullptr; }
    Made operator()(const Rectangle&) const { return nullptr; }
    Made operator()(const Box&) const { return nullptr; }
    Made operator()(const Sphere& sphere) const {
        return std::make_unique<RoundSurface<Sphere>>(Sphere{sphere.center - origin, sphere.radius});
    }
    Made operator()(const Disk& disk) const {
        return std::make_unique<RoundSurface<Disk>>(Disk{disk.center - origin, disk.normal, disk.radius});
    }
    Made operator()(Harmonics harmonics) const {
        harmonics.center -= origin;
        if (harmonics.method == HarmonicMethod::cells)
            return std::make_unique<HarmonicsInCells>(std::move(harmonics));
        return std::make_unique<WholeHarmonics>(std::move(harmonics));
    }
};

}  // namespace

std::unique_ptr<CurvedSurface> curved_surface(const Shape& shape, const Vec3& origin) {
    return std::visit(Maker{origin}, shape);
}

}  // namespace stilb::rays
