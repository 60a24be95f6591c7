// Ear clipping.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "io/mesh/mesh_file.h"

namespace stilb::io {
namespace {

struct Point {
    double x, y;
};

/// Twice the signed area of the triangle abc.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Twice the polygon's area times its normal [Newell], computed from the first corner, so that it stays exact
/// far from the origin.
Vec3 area_vector(const std::vector<Vec3>& polygon) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return sum;
}

/// Drops the axis nearest to the normal: points on one line stay on one line, exactly so for planes across an
/// axis. The result runs counterclockwise, and is of about unit size.
std::vector<Point> flatten(const std::vector<Vec3>& polygon) {
    const Vec3 normal = area_vector(polygon);
    std::size_t dropped = 0;
    for (const std::size_t axis : {1U, 2U})
        if (std::abs(normal[axis]) > std::abs(normal[dropped])) dropped = axis;
    std::size_t first = (dropped + 1) % 3, second = (dropped + 2) % 3;
    if (normal[dropped] < 0) std::swap(first, second);

    double size = 0;
    for (const Vec3& corner : polygon)
        size =
            std::max({size, std::abs((corner - polygon[0])[first]), std::abs((corner - polygon[0])[second])});
    std::vector<Point> points;
    for (const Vec3& corner : polygon) {
        const Vec3 offset = (corner - polygon[0]) / (size > 0 ? size : 1);
        points.push_back({offset[first], offset[second]});
    }
    return points;
}

class EarClipper {
  public:
    explicit EarClipper(std::vector<Point> points) : points_(std::move(points)), links_(points_.size()) {
        const auto count = static_cast<std::uint32_t>(points_.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            links_[i] = {(i + count - 1) % count, (i + 1) % count};
            untried_.push_back(i);
            if (!is_convex(i)) blocking_.push_back(i);
        }
    }

    std::vector<Triangle> clip() && {
        for (std::size_t left = points_.size(); left > 2; --left) {
            while (!untried_.empty() && !is_ear(untried_.front())) untried_.pop_front();
            // Every simple polygon has an ear; of one that is not simple, any corner is cut off.
            cut_off(untried_.empty() ? last_cut_.next : untried_.front());
        }
        return std::move(triangles_);
    }

  private:
    struct Links {
        std::uint32_t previous = 0, next = 0;
        bool operator==(const Links&) const = default;
    };

    /// The tolerance for collinear points, relative to the polygon's size.
    static constexpr double kTolerance = 1e-12;
    static constexpr Links kCut{0, 0};

    bool is_cut(std::uint32_t i) const { return links_[i] == kCut; }

    /// Prefers corners that are not straight: clipping a straight one leaves a T junction, where light leaks
    /// at the neighbour.
    bool is_convex(std::uint32_t i) const {
        const auto [previous, next] = links_[i];
        const Point &a = points_[previous], &b = points_[i], &c = points_[next];
        return turn(a, b, c) > kTolerance * distance(a, c);
    }

    /// Whether a point is on the triangle or its border, but not at a corner: corners coincide where a slit
    /// leads to a hole.
    bool is_covered(const Point& p, const std::array<Point, 3>& triangle) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const Point &a = triangle[i], &b = triangle[(i + 1) % 3];
            if (p.x == a.x && p.y == a.y) return false;
            if (turn(a, b, p) < -kTolerance * distance(a, b)) return false;
        }
        return true;
    }

    bool is_ear(std::uint32_t i) {
        if (is_cut(i) || !is_convex(i)) return false;
        const Links ends = links_[i];
        const std::array triangle{points_[ends.previous], points_[i], points_[ends.next]};
        // If any corner is covered, then a corner that is not convex is. Corners only ever become convex.
        std::erase_if(blocking_, [&](std::uint32_t k) { return is_cut(k) || is_convex(k); });
        return std::none_of(blocking_.begin(), blocking_.end(), [&](std::uint32_t k) {
            return k != ends.previous && k != ends.next && is_covered(points_[k], triangle);
        });
    }

    void cut_off(std::uint32_t i) {
        const Links ends = links_[i];
        triangles_.push_back({ends.previous, i, ends.next});
        links_[ends.previous].next = ends.next;
        links_[ends.next].previous = ends.previous;
        links_[i] = kCut;
        last_cut_ = ends;
        untried_.push_back(ends.previous);  // the only corners that may have become ears
        untried_.push_back(ends.next);
    }

    std::vector<Point> points_;
    std::vector<Links> links_;
    std::deque<std::uint32_t> untried_;
    std::vector<std::uint32_t> blocking_;
    std::vector<Triangle> triangles_;
    Links last_cut_;
};

}  // namespace

std::vector<Triangle> triangulate_polygon(const std::vector<Vec3>& polygon) {
    if (polygon.size() < 3) return {};
    return EarClipper(flatten(polygon)).clip();
}

}  // namespace stilb::io
