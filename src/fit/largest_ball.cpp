// The simplex method on the dual programme: minimise the sum of l_i offset_i where the l_i >= 0 of the walls
// have sum of l_i = 1 and sum of l_i normal_i = 0. Its basis are four walls that hold a ball between them;
// each step exchanges one for the wall that the ball breaks through farthest, and the ball shrinks. It begins
// with a tetrahedron round everything. [Chvatal 1983, Linear programming, chapters 7 and 8]
#include "fit/largest_ball.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace stilb::fit {
namespace {

using Four = std::array<double, 4>;
using Basis = std::array<HalfSpace, 4>;

/// Instead of 0 for the sum of l_i normal_i: pairs of parallel walls, which boxes are made of, would make
/// steps without an end. It prefers a direction so little that the radius changes by 1e-7 of a move.
constexpr Four kAim{1.1e-7, 0.7e-7, -0.9e-7, 1};

constexpr int kMostSteps = 20'000;  // a few dozen are usual
/// Of the reach: by so much walls may be broken through in the end.
constexpr double kSlack = 1e-12;

/// Gaussian elimination with pivots; a singular matrix gives what is not finite.
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

/// The ball that touches all four.
InnerBall ball_of(const Basis& basis) {
    std::array<Four, 4> rows;
    Four offsets;
    for (std::size_t i = 0; i < 4; ++i) rows[i] = column_of(basis[i]), offsets[i] = basis[i].offset;
    const Four x = solve(rows, offsets);
    return {{x[0], x[1], x[2]}, x[3]};
}

/// The parts of the four that make up a vector.
Four parts_of(const Basis& basis, const Four& vector) {
    std::array<Four, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) {
        const Four column = column_of(basis[i]);
        for (std::size_t k = 0; k < 4; ++k) rows[k][i] = column[k];
    }
    return solve(rows, vector);
}

/// The room that the ball's centre has up to the wall where it has least; nullptr where there are no walls.
std::pair<const HalfSpace*, double> nearest_wall(std::span<const HalfSpace> walls, const Vec3& center) {
    const HalfSpace* nearest = nullptr;
    double least = INFINITY;
    for (const HalfSpace& wall : walls) {
        const double room = wall.offset - dot(wall.normal, center);
        if (room < least) least = room, nearest = &wall;
    }
    return {nearest, least};
}

/// Which of the four leaves, so that none of their l_i becomes negative. One has a positive part always, as
/// the parts' sum is 1.
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
