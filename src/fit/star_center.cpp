
#include "fit/star_center.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "geometry/harmonics/surface.h"

namespace stilb::fit {

namespace {

/// Steps of the search, as shares of the size.
constexpr double kFirstStep = 0.25, kLastStep = 0.002;
/// The least distance of the centre from the surface, as a share of the size.
constexpr double kClearance = 0.1;
/// The average number of surplus crossings that is negligible: below it, the centre farthest from the
/// surface is best, because the radius varies least about it.
constexpr double kFewCrossings = 1e-3;

constexpr std::array<Vec3, 6> kAxes{Vec3{1, 0, 0},  Vec3{-1, 0, 0}, Vec3{0, 1, 0},
                                    Vec3{0, -1, 0}, Vec3{0, 0, 1},  Vec3{0, 0, -1}};

/// The planes of all faces, and those of the bounding box, which bound an open mesh; relative to
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
    const Vec3 origin = bounds.middle();
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

/// A search along the axes, with steps that are halved where none improves.
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

    /// Outside of the box the search would not end. Close to the surface there are few crossings
    /// behind it, but a radius of nearly 0.
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
        const Vec3 offset = vertex - from;
        directions.push_back(offset / std::max(length(offset), 1e-300));
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
    const Vec3 origin = bounds.middle();
    const InnerBall ball = largest_ball(walls_of(mesh, bounds, origin), 1.01 * length(bounds.max - origin));
    const Vec3 middle = origin + ball.center;
    if (ball.radius > 0) return {middle, ball.radius};
    const Search search(mesh, caster, bounds);
    const Candidate from_volume = search.from(middle_of_volume(mesh, bounds)),
                    from_ball = search.from(middle);
    return {(from_volume.cost <= from_ball.cost ? from_volume : from_ball).center, ball.radius};
}

// The simplex method on the dual programme: minimise the sum of l_i offset_i where the l_i >= 0 of the walls
// have sum of l_i = 1 and sum of l_i normal_i = 0. Its basis are four planes that enclose a ball;
// each step exchanges one for the plane that the ball exceeds most, and the ball shrinks. It begins
// with a tetrahedron around everything. [Chvatal 1983, Linear programming, chapters 7 and 8]

namespace {

using Four = std::array<double, 4>;
using Basis = std::array<HalfSpace, 4>;

/// Replaces 0 for the sum of l_i normal_i: pairs of parallel planes, as in boxes, would lead to
/// endless steps. It prefers a direction so little that the radius changes by 1e-7 of a move.
constexpr Four kAim{1.1e-7, 0.7e-7, -0.9e-7, 1};

constexpr int kMostSteps = 20'000;  // a few dozen are usual
/// The final tolerance of the planes, as a share of the reach.
constexpr double kSlack = 1e-12;

/// Gaussian elimination with pivots; a singular matrix gives non-finite values.
Four solve(std::array<Four, 4> rows, Four right) {
    for (std::size_t i = 0; i < 4; ++i) {
        std::size_t pivot = i;
        for (std::size_t k = i + 1; k < 4; ++k) {
            if (std::abs(rows[k][i]) > std::abs(rows[pivot][i])) pivot = k;
        }
        std::swap(rows[i], rows[pivot]);
        std::swap(right[i], right[pivot]);
        for (std::size_t k = i + 1; k < 4; ++k) {
            const double factor = rows[k][i] / rows[i][i];
            for (std::size_t j = i; j < 4; ++j) rows[k][j] -= factor * rows[i][j];
            right[k] -= factor * right[i];
        }
    }
    for (std::size_t i = 4; i-- > 0;) {
        for (std::size_t j = i + 1; j < 4; ++j) right[i] -= rows[i][j] * right[j];
        right[i] /= rows[i][i];
    }
    return right;
}

Four column_of(const HalfSpace& wall) { return {wall.normal.x, wall.normal.y, wall.normal.z, 1}; }

/// The ball that touches all four planes.
InnerBall ball_of(const Basis& basis) {
    std::array<Four, 4> rows;
    Four offsets;
    for (std::size_t i = 0; i < 4; ++i) rows[i] = column_of(basis[i]), offsets[i] = basis[i].offset;
    const Four x = solve(rows, offsets);
    return {{x[0], x[1], x[2]}, x[3]};
}

/// The coefficients of a vector in terms of the four.
Four parts_of(const Basis& basis, const Four& vector) {
    std::array<Four, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) {
        const Four column = column_of(basis[i]);
        for (std::size_t k = 0; k < 4; ++k) rows[k][i] = column[k];
    }
    return solve(rows, vector);
}

/// The plane that is nearest to the ball's centre, with the distance; nullptr where there are no planes.
std::pair<const HalfSpace*, double> nearest_wall(std::span<const HalfSpace> walls, const Vec3& center) {
    const HalfSpace* nearest = nullptr;
    double least = INFINITY;
    for (const HalfSpace& wall : walls) {
        const double room = wall.offset - dot(wall.normal, center);
        if (room < least) least = room, nearest = &wall;
    }
    return {nearest, least};
}

/// The index of the plane that leaves the basis, so that no l_i becomes negative. One coefficient is always
/// positive, because their sum is 1.
std::size_t leaving(const Basis& basis, const HalfSpace& entering) {
    const Four l = parts_of(basis, kAim), parts = parts_of(basis, column_of(entering));
    std::size_t leaves = 0;
    double least = INFINITY;
    for (std::size_t i = 0; i < 4; ++i) {
        if (parts[i] > 1e-9 && l[i] / parts[i] < least) least = l[i] / parts[i], leaves = i;
    }
    return leaves;
}

}  // namespace

InnerBall largest_ball(std::span<const HalfSpace> walls, double reach) {
    const double s = std::sqrt(1 / 3.);
    Basis basis{HalfSpace{{s, s, s}, reach}, HalfSpace{{s, -s, -s}, reach}, HalfSpace{{-s, s, -s}, reach},
                HalfSpace{{-s, -s, s}, reach}};
    InnerBall ball = ball_of(basis);
    for (int step = 0; step < kMostSteps; ++step) {
        const auto [wall, room] = nearest_wall(walls, ball.center);
        if (wall == nullptr || room >= ball.radius - kSlack * reach) return ball;
        Basis next = basis;
        next[leaving(basis, *wall)] = *wall;
        const InnerBall smaller = ball_of(next);
        if (!is_finite(smaller.center)) break;
        basis = next, ball = smaller;
    }
    return {ball.center, nearest_wall(walls, ball.center).second};
}

}  // namespace stilb::fit
