// HarmonicCells::classifications(): crossing() in single precision with bounds of its errors, in a loop that
// compilers turn into vector instructions. Therefore it has no branches, and no conditions except comparisons
// of two numbers.
#include <cmath>
#include <limits>

#include "base/rays.h"
#include "geometry/harmonics/cells.h"

namespace stilb::geometry {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// The sum of rounding errors, in shares of the coordinates: 30 unit roundoffs on the longest evaluation
/// path, the planes at the sides, and a reserve.
constexpr float kRounding = 48 * 0.5F * std::numeric_limits<float>::epsilon();
/// Positions less certain than this share of the least distance from the origin classify nothing.
constexpr float kMostDoubt = 0.01F;

float lesser(float a, float b) { return a < b ? a : b; }
float greater(float a, float b) { return a > b ? a : b; }

struct Vec3f {
    float x, y, z;
};
float dot(const Vec3f& a, const Vec3f& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The interval of a ray where linear functions of the distance are not negative.
struct Stretch {
    float low, high;

    void keep(float at_0, float slope) {
        const float root = -at_0 / slope, if_level = at_0 < 0 ? kInfinity : -kInfinity;
        low = greater(low, slope > 0 ? root : slope < 0 ? -kInfinity : if_level);
        high = lesser(high, slope < 0 ? root : kInfinity);
    }
};

float sum_of_amounts(const std::array<float, 3>& v) {
    return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}

}  // namespace

struct HarmonicCells::FloatCell {
    Vec3f center, x_axis, y_axis, z_axis;  ///< of the body in the world, and of the cell's face
    float low, high;
    float s, half_s, per_s, t, half_t, per_t;
    Quadratic q;
    float rest;
    float magnitude;  ///< of what a ray's coordinates are subtracted from, and of the cell's own
    float most_doubt;
    float change;  ///< of W - w by a position's error, at most

    FloatCell(const Outline& cell, const Span& column, const Span& row, const PacketPlacement& placement);
    Classification classification(const Vec3f& origin, const Vec3f& direction, float start, float end) const;
    LaneClassifications classifications(const RayPacket& rays) const;
};

HarmonicCells::FloatCell::FloatCell(const Outline& cell, const Span& column, const Span& row,
                                    const PacketPlacement& placement)
    : low(cell.low), high(cell.high), q(cell.quadratic) {
    const CubeFace face(cell.face);
    const auto axis = [&](std::size_t number, double sign) {
        const auto [x, y, z] = placement.axes[number];
        const auto factor = static_cast<float>(sign);
        return Vec3f{factor * x, factor * y, factor * z};
    };
    center = {placement.center[0], placement.center[1], placement.center[2]};
    x_axis = axis(face.i, 1), y_axis = axis(face.j, 1), z_axis = axis(face.k, face.sign);
    s = static_cast<float>(column.middle), half_s = static_cast<float>(column.half), per_s = 1 / half_s;
    t = static_cast<float>(row.middle), half_t = static_cast<float>(row.half), per_t = 1 / half_t;
    const float per_length = sum_of_amounts(placement.axes[0]);  // or up to sqrt(3) times that
    magnitude = per_length * sum_of_amounts(placement.center) + high;
    most_doubt = kMostDoubt * low;
    const float w_most = 1 / ((1 - kMostDoubt) * low);
    const float bends = 2 * (std::abs(q[3]) + std::abs(q[4]) + std::abs(q[5]));
    const float along_s = (std::abs(q[1]) + bends + cell.rest_a) * per_s;
    const float along_t = (std::abs(q[2]) + bends + cell.rest_b) * per_t;
    change = 2 * w_most * (2 * along_s + 2 * along_t + w_most);
    rest = cell.rest + kRounding * w_most;
}

[[gnu::always_inline]] inline Classification HarmonicCells::FloatCell::classification(const Vec3f& origin,
                                                                                      const Vec3f& direction,
                                                                                      float start,
                                                                                      float end) const {
    const Vec3f from{origin.x - center.x, origin.y - center.y, origin.z - center.z};
    const float x = dot(x_axis, from), y = dot(y_axis, from), z = dot(z_axis, from);
    const float dx = dot(x_axis, direction), dy = dot(y_axis, direction), dz = dot(z_axis, direction);

    // The stretch over the cell, widened by the error of positions.
    const float doubt = kRounding * (std::abs(x) + std::abs(y) + std::abs(z) + magnitude);
    Stretch stretch{start, end};
    stretch.keep(z - low + doubt, dz);
    stretch.keep(high - z + doubt, -dz);
    stretch.keep(x + (half_s - s) * z + doubt, dx + (half_s - s) * dz);
    stretch.keep((half_s + s) * z - x + doubt, (half_s + s) * dz - dx);
    stretch.keep(y + (half_t - t) * z + doubt, dy + (half_t - t) * dz);
    stretch.keep((half_t + t) * z - y + doubt, (half_t + t) * dz - dy);
    const auto [near, far] = stretch;

    // The quadratic along it.
    const float w = 1 / (z + near * dz), last_w = 1 / (z + far * dz);
    const float a = ((x + near * dx) * w - s) * per_s, da = ((x + far * dx) * last_w - s) * per_s - a;
    const float b = ((y + near * dy) * w - t) * per_t, db = ((y + far * dy) * last_w - t) * per_t - b;
    const float along_a = q[1] + q[3] * a + q[4] * b, along_b = q[2] + q[5] * b;
    const float first = q[0] + along_a * a + along_b * b - w;
    const float slope = (along_a + q[3] * a) * da + (along_b + q[4] * a + q[5] * b) * db - (last_w - w);
    const float bend = (q[3] * da + q[4] * db) * da + q[5] * db * db;
    const float last = first + slope + bend;
    const float turning = slope * (slope + 2 * bend) < 0 ? first - slope * slope / (4 * bend) : first;
    const float least = lesser(lesser(first, last), turning);
    const float greatest = greater(greater(first, last), turning);

    const float bound = rest + doubt * change;
    const float apart = greater(least - bound, -bound - greatest);
    const float across = lesser(-bound - least, greatest - bound);
    const Classification over = apart > 0    ? Classification::misses
                                : across > 0 ? Classification::meets
                                             : Classification::unclear;
    const Classification sure = near >= far ? Classification::misses : over;
    return doubt < most_doubt ? sure : Classification::unclear;
}

STILB_VECTORIZED LaneClassifications HarmonicCells::FloatCell::classifications(const RayPacket& rays) const {
    LaneClassifications classifications;
    for (std::size_t n = 0; n < kPacketWidth; ++n) {
        classifications[n] = classification({rays.origin_x[n], rays.origin_y[n], rays.origin_z[n]},
                                            {rays.direction_x[n], rays.direction_y[n], rays.direction_z[n]},
                                            rays.start[n], rays.end[n]);
    }
    return classifications;
}

LaneClassifications HarmonicCells::classifications(std::size_t number, const RayPacket& rays,
                                                   const PacketPlacement& placement) const {
    const Outline& outline = outlines_[number];
    return FloatCell(outline, spans_[outline.column], spans_[outline.row], placement).classifications(rays);
}

}  // namespace stilb::geometry
