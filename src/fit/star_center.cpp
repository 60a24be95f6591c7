#include "fit/star_center.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fit/largest_ball.h"
#include "geometry/harmonics/parallel_grid.h"

namespace stilb::fit {
namespace {

/// Steps of the search, as parts of the size.
constexpr double kFirstStep = 0.25, kLastStep = 0.002;
/// What the centre should be away from the surface, as a part of the size.
constexpr double kClearance = 0.1;
/// Superfluous crossings that do not matter: where there are no more, the centre that is farthest from the
/// surface is best, as the radius varies least about it.
constexpr double kFewCrossings = 1e-3;

constexpr std::array<Vec3, 6> kAxes{Vec3{1, 0, 0},  Vec3{-1, 0, 0}, Vec3{0, 1, 0},
                                    Vec3{0, -1, 0}, Vec3{0, 0, 1},  Vec3{0, 0, -1}};

/// The planes of all faces, and those of the bounding box, which hold where a mesh is open; relative to
/// `origin`.
std::vector<HalfSpace> walls_of(const Mesh& mesh, const Bounds& bounds, const Vec3& origin) {
    std::vector<HalfSpace> walls;
    walls.reserve(mesh.triangles.size() + kAxes.size());
    const auto add = [&](const Vec3& normal, const Vec3& point) {
        walls.push_back({normal, dot(normal, point - origin)});
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 doubled = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        if (squared_length(doubled) > 0) add(normalized(doubled), mesh.vertices[a]);
    }
    for (const Vec3& axis : kAxes) add(axis, axis.x + axis.y + axis.z > 0 ? bounds.max : bounds.min);
    return walls;
}

/// The middle of the bounding box where the mesh encloses nothing.
Vec3 middle_of_volume(const Mesh& mesh, const Bounds& bounds) {
    const Vec3 origin = 0.5 * (bounds.min + bounds.max);
    double volume = 0;
    Vec3 moment;
    for (const auto& [ia, ib, ic] : mesh.triangles) {
        const Vec3 a = mesh.vertices[ia] - origin, b = mesh.vertices[ib] - origin,
                   c = mesh.vertices[ic] - origin;
        const double own = dot(a, cross(b, c));
        volume += own;
        moment += own / 4 * (a + b + c);
    }
    const Vec3 middle = origin + moment / volume;
    const bool is_within = is_finite(middle) && length(middle - origin) <= length(bounds.max - origin);
    return is_within ? middle : origin;
}

struct Candidate {
    Vec3 center;
    double cost = 0;
};

/// Along the axes, by steps that are halved where none of them is better.
class Search {
  public:
    Search(const Mesh& mesh, const RadialCaster& caster, const Bounds& bounds)
        : mesh_(mesh),
          caster_(caster),
          bounds_(bounds),
          size_(2 * bounds.half_extent()),
          directions_(geometry::even_grid(kParallels).directions()) {}

    Candidate from(const Vec3& start) const {
        Candidate best{start, cost_at(start)};
        for (double step = kFirstStep; step > kLastStep;) {
            const Candidate before = best;
            for (const Vec3& axis : kAxes) {
                const Vec3 center = before.center + step * size_ * axis;
                const double cost = cost_at(center);
                if (cost < best.cost) best = {center, cost};
            }
            if (!(best.cost < before.cost)) step /= 2;
        }
        return best;
    }

  private:
    static constexpr int kParallels = 24;

    /// Outside the box the search would go on without end. Close to the surface there are few crossings
    /// behind it, and a radius that comes to nearly 0.
    double cost_at(const Vec3& center) const {
        Bounds extended = bounds_;
        extended.include(center);
        if (extended.min != bounds_.min || extended.max != bounds_.max) return INFINITY;
        double nearest = size_;
        for (const double distance : caster_.innermost(center, directions_)) {
            nearest = std::fmin(nearest, distance);  // which leaves NaN out
        }
        const double clearance = nearest / size_;
        return std::max(superfluous_crossings(mesh_, center), kFewCrossings) - kFewCrossings * clearance +
               std::max(0.0, 1 - clearance / kClearance);
    }

    const Mesh& mesh_;
    const RadialCaster& caster_;
    Bounds bounds_;
    double size_;
    std::vector<Vec3> directions_;
};

}  // namespace

Bounds bounds_of_faces(const Mesh& mesh) {
    Bounds bounds;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) bounds.include(mesh.vertices[corner]);
    }
    return bounds;
}

/// Solid angles of triangles: [van Oosterom and Strackee 1983].
double superfluous_crossings(const Mesh& mesh, const Vec3& from) {
    std::vector<Vec3> directions;
    directions.reserve(mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) {
        const Vec3 way = vertex - from;
        directions.push_back(way / std::max(length(way), 1e-300));
    }
    double all = 0, behind = 0;
    for (const auto& [ia, ib, ic] : mesh.triangles) {
        const Vec3 &a = directions[ia], &b = directions[ib], &c = directions[ic];
        const double own = 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
        all += own;
        behind += std::max(0.0, -own);
    }
    constexpr double sphere = 4 * std::numbers::pi;
    return (2 * behind + std::abs(all - sphere)) / sphere;
}

StarCenter find_star_center(const Mesh& mesh, const RadialCaster& caster) {
    const Bounds bounds = bounds_of_faces(mesh);
    const Vec3 origin = 0.5 * (bounds.min + bounds.max);
    const InnerBall ball = largest_ball(walls_of(mesh, bounds, origin), 1.01 * length(bounds.max - origin));
    const Vec3 middle = origin + ball.center;
    if (ball.radius > 0) return {middle, ball.radius};
    const Search search(mesh, caster, bounds);
    const Candidate from_volume = search.from(middle_of_volume(mesh, bounds)),
                    from_ball = search.from(middle);
    return {(from_volume.cost <= from_ball.cost ? from_volume : from_ball).center, ball.radius};
}

}  // namespace stilb::fit
