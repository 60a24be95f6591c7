#include "scene/fine_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace stilb::scene {
namespace {

/// The rounding error of coordinates, over the largest of them, and the share of a small opening that may be
/// lost by it.
constexpr double kRounding = 0x1p-24, kLostShare = 1e-4;
/// Larger scenes have a centre near to where light is measured anyway (lift.cpp).
constexpr double kLargestHalfExtent_m = 32;
/// A measured point sees light through an opening that is so many of its widths away.
constexpr double kSeenWidths = 8;
/// A limit of the work, in visits of a triangle by a measured point.
constexpr std::size_t kMostVisits = 20'000'000;

double squared_distance(const Bounds& box, const Vec3& point) {
    const auto beyond = [](double low, double high, double x) { return std::max({low - x, x - high, 0.0}); };
    return squared_length(Vec3{beyond(box.min.x, box.max.x, point.x), beyond(box.min.y, box.max.y, point.y),
                               beyond(box.min.z, box.max.z, point.z)});
}

double shortest_edge(const std::array<Vec3, 3>& corners) {
    return std::sqrt(
        std::min({squared_length(corners[1] - corners[0]), squared_length(corners[2] - corners[1]),
                  squared_length(corners[0] - corners[2])}));
}

}  // namespace

bool sees_fine_things(const Scene& scene, std::span<const Vec3> measured) {
    if (measured.empty()) return false;
    const double coarse_m =
        kRounding / kLostShare * std::min(bounds_of(scene).half_extent(), kLargestHalfExtent_m);
    std::size_t visits = 0;
    const auto is_seen = [&](const std::array<Vec3, 3>& corners) {
        const double edge_m = shortest_edge(corners);
        if (edge_m >= coarse_m || visits > kMostVisits) return false;
        visits += measured.size();
        Bounds box;
        for (const Vec3& corner : corners) box.include(corner);
        return std::ranges::any_of(measured, [&](const Vec3& point) {
            return squared_distance(box, point) < kSeenWidths * kSeenWidths * edge_m * edge_m;
        });
    };
    return std::ranges::any_of(scene.objects, [&](const Object& object) {
        for (std::size_t t = 0; t < geometry::triangle_count(object.shape); ++t) {
            if (is_seen(geometry::corners_of(object.shape, t))) return true;
        }
        return false;
    });
}

}  // namespace stilb::scene
