#include "transport/direct/lamp_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <variant>

namespace stilb::transport {
namespace {

/// The corners of a flat element, or of a polygon around it; of a sphere, those of its cube.
std::vector<Vec3> corners_of(const lights::EmitterElement& element, double sphere_margin_m) {
    return std::visit(
        [&]<typename S>(const S& shape) -> std::vector<Vec3> {
            if constexpr (std::is_same_v<S, Rectangle>) {
                const Vec3 &c = shape.corner, &u = shape.edge_u, &v = shape.edge_v;
                return {c, c + u, c + u + v, c + v};
            } else if constexpr (std::is_same_v<S, Disk>) {
                const Frame frame = Frame::around(shape.normal);
                const Vec3 u = shape.radius * frame.u, v = shape.radius * frame.v, &c = shape.center;
                return {c + u + v, c + u - v, c - u - v, c - u + v};
            } else if constexpr (std::is_same_v<S, Sphere>) {
                std::vector<Vec3> corners;
                const double r = shape.radius + sphere_margin_m;
                for (int i = 0; i < 8; ++i)
                    corners.push_back(shape.center + Vec3{i & 1 ? r : -r, i & 2 ? r : -r, i & 4 ? r : -r});
                return corners;
            } else if constexpr (std::is_same_v<S, Harmonics>) {
                return {};
            } else {
                return {shape.begin(), shape.end()};
            }
        },
        element.shape);
}

/// Bounds of the lift of an element's points: it grows with their largest coordinate.
struct LiftRange {
    double least_m, most_m;
};
LiftRange lifts_of(const lights::EmitterElement& element, const std::vector<Vec3>& corners,
                   const Lift& lift) {
    Bounds bounds;
    double most_m = 0;
    for (const Vec3& corner : corners) {
        bounds.include(corner - lift.center());
        most_m = std::max(most_m, lift.offset_m(corner, element.size_m));
    }
    Vec3 nearest{};
    const auto nearest_to_0 = [](double low, double high) { return std::max({0.0, low, -high}); };
    nearest = {nearest_to_0(bounds.min.x, bounds.max.x), nearest_to_0(bounds.min.y, bounds.max.y),
               nearest_to_0(bounds.min.z, bounds.max.z)};
    return {lift.relative_offset_m(nearest, element.size_m), most_m};
}

bool has_convex_faces(const Shape& shape) {
    return std::holds_alternative<Box>(shape) || std::holds_alternative<Rectangle>(shape) ||
           std::holds_alternative<Disk>(shape);
}

/// All corners lie in or behind the planes of all elements.
bool hides_nothing_of_itself(std::span<const lights::EmitterElement> elements) {
    if (elements.size() == 1) return true;
    for (const lights::EmitterElement& element : elements) {
        const auto* plane = std::get_if<std::array<Vec3, 3>>(&element.shape);
        if (!plane || !element.normal || !is_finite(*element.normal)) return false;
        for (const lights::EmitterElement& other : elements) {
            constexpr double rounding = 1e-9;
            for (const Vec3& corner : corners_of(other, 0)) {
                const Vec3 towards = corner - (*plane)[0];
                if (dot(towards, *element.normal) > rounding * length(towards)) return false;
            }
        }
    }
    return true;
}

}  // namespace

LampHull::LampHull(ObjectId object, std::span<const lights::EmitterElement> elements, const Lift& lift)
    : object_(object), is_convex_(hides_nothing_of_itself(elements)) {
    if (!is_convex_) return;
    for (const lights::EmitterElement& element : elements) add(element, lift);
}

void LampHull::add(const lights::EmitterElement& element, const Lift& lift) {
    const std::vector<Vec3> corners = corners_of(element, 0);
    const LiftRange lifts = lifts_of(element, corners, lift);
    if (!element.normal) {
        const std::vector<Vec3> lifted = corners_of(element, lifts.most_m);
        corners_.insert(corners_.end(), lifted.begin(), lifted.end());
        return;
    }
    for (const Vec3& corner : corners) {
        corners_.push_back(corner + lifts.least_m * *element.normal);
        corners_.push_back(corner + lifts.most_m * *element.normal);
    }
}

bool LampHull::is_hidden_from(const Vec3& point, const Scene& scene, const rays::RayCaster& caster) const {
    std::optional<rays::Hit> face;
    for (const Vec3& corner : corners_) {
        const double distance_m = length(corner - point);
        const auto hit = caster.closest(point, (corner - point) / distance_m);
        if (!hit || !(hit->distance_m < distance_m)) return false;
        if (!face) {
            const bool hides = has_convex_faces(scene.object(hit->object).shape) &&
                               !passes_straight(scene.material(hit->material));
            if (!hides) return false;
            face = hit;
        }
        if (hit->object != face->object || !(hit->normal == face->normal)) return false;
    }
    return face.has_value();
}

}  // namespace stilb::transport
