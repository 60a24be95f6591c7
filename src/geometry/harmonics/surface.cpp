#include "geometry/harmonics/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "math/first_root.h"

namespace stilb::geometry {
namespace {

constexpr double kNarrowest = 1e-9;  ///< interval [rad] that is not divided any more

}  // namespace

/// A ray about the origin.
struct HarmonicSurface::Line {
    Vec3 direction;
    Vec3 towards;        ///< unit, from the origin to the closest point, across `direction`
    double closest = 0;  ///< distance along the ray where it is closest to the origin
    double offset = 0;   ///< of that point from the origin

    Line(const Vec3& origin, const Vec3& along) : direction(along), closest(-dot(origin, along)) {
        const Frame frame = Frame::around(along);
        const double u = dot(origin, frame.u), v = dot(origin, frame.v);
        offset = std::hypot(u, v);
        towards = offset > 0 ? (u * frame.u + v * frame.v) / offset : frame.u;
    }

    /// At a distance from the closest point.
    Vec3 position(double beyond) const { return offset * towards + beyond * direction; }
    Vec3 direction_at(double angle) const { return std::cos(angle) * towards + std::sin(angle) * direction; }
    HarmonicCrossing crossing(double beyond, bool is_entered) const {
        return {closest + beyond, normalized(position(beyond)), is_entered};
    }
};

HarmonicSurface::HarmonicSurface(math::HarmonicSeries<double> radius) : radius_(std::move(radius)) {
    const math::HarmonicRange range = range_of(radius_);
    least_radius_ = range.least, greatest_radius_ = range.greatest;
    if (!(least_radius_ > 0)) {
        throw InputError(
            "the radius of a surface by spherical harmonics comes to 0 or nearly so (its least value is "
            "below 3 % of the greatest): it must be above 0 in all directions");
    }
}

Vec3 HarmonicSurface::normal_at(const Vec3& direction) const {
    const auto [value, gradient] = radius_.with_gradient(direction);
    return normalized(direction - gradient / value);
}

std::optional<HarmonicCrossing> HarmonicSurface::first_crossing(const Vec3& origin, const Vec3& direction,
                                                                double start, double end) const {
    const Line line(origin, direction);
    if (line.offset >= greatest_radius_) return std::nullopt;
    const auto reach = [&](double radius) {
        return std::sqrt(std::max(0.0, radius * radius - line.offset * line.offset));
    };
    const double outer = reach(greatest_radius_), inner = reach(least_radius_);
    const double low = std::max(start - line.closest, -outer), high = std::min(end - line.closest, outer);
    if (const auto found = crossing_between(line, low, std::min(high, -inner))) return found;
    return crossing_between(line, std::max(low, inner), high);
}

/// On one arm of the ray, between distances from the closest point.
std::optional<HarmonicCrossing> HarmonicSurface::crossing_between(const Line& line, double low,
                                                                  double high) const {
    if (!(low < high)) return std::nullopt;
    // R changes along the ray by at most L max R times the angle's change, which is offset / |x|^2.
    const double slope = radius_.degree() * greatest_radius_ * line.offset / (least_radius_ * least_radius_);
    const double outwards = std::sqrt(1 - std::min(1.0, std::pow(line.offset / least_radius_, 2)));
    return slope < 0.5 * outwards ? crossing_of_arm(line, low, high) : crossing_of_arc(line, low, high);
}

/// Close to the origin: |x| - R is monotone on each arm.
std::optional<HarmonicCrossing> HarmonicSurface::crossing_of_arm(const Line& line, double low,
                                                                 double high) const {
    const auto excess = [&](double beyond) {
        const Vec3 position = line.position(beyond);
        const double distance = length(position);
        const Vec3 outwards = position / distance;
        const auto [value, gradient] = radius_.with_gradient(outwards);
        const Vec3 turn = (line.direction - dot(line.direction, outwards) * outwards) / distance;
        return std::pair(distance - value, dot(line.direction, outwards) - dot(gradient, turn));
    };
    const auto beyond = math::root_of_monotone(excess, low, high);
    if (!beyond) return std::nullopt;
    return line.crossing(*beyond, excess(low).first > 0);
}

std::optional<HarmonicCrossing> HarmonicSurface::crossing_of_arc(const Line& line, double low,
                                                                 double high) const {
    const double order = radius_.degree() + 1.0, middle = 0.5 * (greatest_radius_ + least_radius_);
    const double curvature = middle + order * order * (greatest_radius_ - middle);
    const auto depth = [&](double angle) {
        const double cosine = std::cos(angle), sine = std::sin(angle);
        const auto [value, gradient] = radius_.with_gradient(line.direction_at(angle));
        const Vec3 turn = cosine * line.direction - sine * line.towards;
        return std::pair(value * cosine - line.offset, dot(gradient, turn) * cosine - value * sine);
    };
    const double from = std::atan(low / line.offset), to = std::atan(high / line.offset);
    const bool is_outside = depth(from).first < 0;
    const auto angle = math::first_root(depth, curvature, kNarrowest, from, to, is_outside);
    if (!angle) return std::nullopt;
    return line.crossing(line.offset * std::tan(*angle), is_outside);
}

}  // namespace stilb::geometry
