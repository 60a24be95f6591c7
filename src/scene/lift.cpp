// The centre of ray queries: single precision is best there.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <variant>
#include <vector>

#include "scene/scene.h"

namespace stilb::scene {
namespace {

/// Limits of the work for one choice, in visits of a triangle or an object by a measured point.
constexpr std::size_t kMostVisits = 20'000'000;
constexpr std::size_t kMostPoints = 32;

/// A gap is wider than so many extents of what is near to lamps and measured points. Offsets that suit rays
/// from beyond it would be coarse for all that is near; such rays end above the surface by a share of their
/// length instead.
constexpr double kGap = 32;

/// A place where precision is wanted.
struct Vote {
    Vec3 at;
    double weight = 1;
};

Vec3 nearest_in(const Bounds& box, const Vec3& to) {
    return {std::clamp(to.x, box.min.x, box.max.x), std::clamp(to.y, box.min.y, box.max.y),
            std::clamp(to.z, box.min.z, box.max.z)};
}

/// About the point of a shape that is nearest to a measured one.
Vec3 nearest_point(const Shape& shape, const Vec3& to) {
    const auto* mesh = std::get_if<Mesh>(&shape);
    if (mesh == nullptr) return nearest_in(geometry::bounds_of(shape), to);
    Vec3 nearest;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
        Bounds box;
        for (const Vec3& corner : mesh->corners_of(t)) box.include(corner);
        const Vec3 point = nearest_in(box, to);
        const double squared_m2 = squared_length(point - to);
        if (squared_m2 < least) nearest = point, least = squared_m2;
    }
    return nearest;
}

/// The coordinate below and above which lies half of the votes.
Vec3 median(std::span<const Vote> votes) {
    double total = 0;
    for (const Vote& vote : votes) total += vote.weight;
    std::vector<std::size_t> order(votes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto along = [&](std::size_t axis) {
        std::ranges::sort(order, {}, [&](std::size_t i) { return votes[i].at[axis]; });
        double below = 0;
        for (const std::size_t i : order) {
            below += votes[i].weight;
            if (below > total / 2) return votes[i].at[axis];
        }
        return votes[order.back()].at[axis];
    };
    return {along(0), along(1), along(2)};
}

/// Of a mesh the median of its vertices: a triangle that was left far away does not count.
Vec3 middle_of(const Shape& shape) {
    const auto* mesh = std::get_if<Mesh>(&shape);
    if (mesh == nullptr) return geometry::bounds_of(shape).middle();
    std::vector<double> values(mesh->vertices.size());
    const auto along = [&](std::size_t axis) {
        std::ranges::transform(mesh->vertices, values.begin(), [&](const Vec3& v) { return v[axis]; });
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::ranges::nth_element(values, middle);
        return *middle;
    };
    return {along(0), along(1), along(2)};
}

/// Each object and each point light has a vote, or one for each of the measured points: where it is nearest
/// to that, and the more the nearer it is.
std::vector<Vote> votes_of(const Scene& scene, std::span<const Vec3> measured) {
    std::size_t visits = 1;
    for (const Object& object : scene.objects) {
        const auto* mesh = std::get_if<Mesh>(&object.shape);
        visits += mesh == nullptr ? 1 : mesh->triangles.size();
    }
    const std::size_t most = std::clamp<std::size_t>(kMostVisits / visits, 1, kMostPoints);
    const std::size_t count = std::min(most, measured.size());
    std::vector<Vote> votes;
    const auto add = [&](const Vec3& middle, const auto& nearest) {
        if (count == 0) votes.push_back({middle});
        for (std::size_t i = 0; i < count; ++i) {
            // Both ends of the list are among the points.
            const Vec3& point = measured[count == 1 ? 0 : i * (measured.size() - 1) / (count - 1)];
            const Vec3 at = nearest(point);
            const double falloff = 1 + squared_length(at - point);
            votes.push_back({at, 1 / (falloff * falloff)});
        }
    };
    for (const Object& object : scene.objects) {
        if (geometry::bounds_of(object.shape).is_empty()) continue;
        add(count == 0 ? middle_of(object.shape) : Vec3{},
            [&](const Vec3& point) { return nearest_point(object.shape, point); });
    }
    for (const Light& light : scene.lights) {
        if (const auto origin = lights::point_origin(light))
            add(origin->position, [&](const Vec3&) { return origin->position; });
    }
    return votes;
}

/// The median of the votes; where it lies between groups of them, the vote that is nearest to it.
Vec3 center_of(const Scene& scene, std::span<const Vec3> measured) {
    const std::vector<Vote> votes = votes_of(scene, measured);
    const Vec3 middle = median(votes);
    const Vec3 nearest =
        std::ranges::min(votes, {}, [&](const Vote& vote) { return squared_length(vote.at - middle); }).at;
    return largest_coordinate(nearest - middle) > kLargeHalfExtent_m ? nearest : middle;
}

/// The bounds of the lamps and of the measured points.
Bounds lit_places(const Scene& scene, std::span<const Vec3> measured) {
    Bounds places;
    for (const Vec3& point : measured) places.include(point);
    for (const Light& light : scene.lights) {
        if (const auto place = place_of(scene, light)) places.include(*place);
        if (const auto object = lights::emitting_object(light)) {
            const Bounds lamp = geometry::bounds_of(scene.object(*object).shape);
            places.include(lamp.min), places.include(lamp.max);
        }
    }
    return places;
}

double extent(const Bounds& box) { return 2 * box.half_extent(); }

/// The largest coordinate of the way from one box to the other.
double distance(const Bounds& a, const Bounds& b) {
    return std::max({a.min.x - b.max.x, a.min.y - b.max.y, a.min.z - b.max.z, b.min.x - a.max.x,
                     b.min.y - a.max.y, b.min.z - a.max.z, 0.0});
}

/// The extent of lamps, measured points and what is near to them; infinite where no gap lies between them and
/// the rest. The more is lit and measured, the larger it is.
double near_extent_m(const Scene& scene, std::span<const Vec3> measured) {
    struct Things {
        double nearest_m = Bounds::kInfinity;
        Bounds bounds;
    };
    Bounds near = lit_places(scene, measured);
    std::map<int, Things> by_distance;  // by powers of two, so that nothing has to be sorted
    const auto add = [&, places = near](const Bounds& thing) {
        const double distance_m = distance(places, thing);
        auto& [nearest_m, bounds] = by_distance[std::ilogb(distance_m)];
        nearest_m = std::min(nearest_m, distance_m);
        bounds.include(thing.min), bounds.include(thing.max);
    };
    for (const Object& object : scene.objects) {
        const Bounds box = geometry::bounds_of(object.shape);
        const std::size_t triangles = geometry::triangle_count(object.shape);
        if (box.is_empty()) continue;
        // Only of larger things a part may lie beyond a gap.
        if (triangles == 0 || extent(box) <= kGap * extent(near)) {
            add(box);
            continue;
        }
        for (std::size_t t = 0; t < triangles; ++t) {
            Bounds part;
            for (const Vec3& corner : geometry::corners_of(object.shape, t)) part.include(corner);
            add(part);
        }
    }
    for (const auto& [exponent, things] : by_distance) {
        if (extent(near) > 0 && things.nearest_m > kGap * extent(near)) return extent(near);
        near.include(things.bounds.min), near.include(things.bounds.max);
    }
    return Bounds::kInfinity;
}

}  // namespace

Lift lift_of(const Scene& scene, std::span<const Vec3> measured, bool sees_fine_things) {
    const Bounds bounds = bounds_of(scene);
    const double near_m = measured.empty() ? Bounds::kInfinity : near_extent_m(scene, measured);
    const bool is_large =
        bounds.half_extent() > kLargeHalfExtent_m || std::isfinite(near_m) || sees_fine_things;
    const Vec3 center = is_large ? center_of(scene, measured) : bounds.middle();
    double half_extent_m =
        is_large ? std::max(largest_coordinate(bounds.max - center), largest_coordinate(bounds.min - center))
                 : bounds.half_extent();
    double nearest_m = measured.empty() ? 0 : std::numeric_limits<double>::infinity();
    for (const Vec3& point : measured) {
        half_extent_m = std::max(half_extent_m, largest_coordinate(point - center));
        nearest_m = std::min(nearest_m, largest_coordinate(point - center));
    }
    return {center, half_extent_m, nearest_m, near_m};
}

}  // namespace stilb::scene
