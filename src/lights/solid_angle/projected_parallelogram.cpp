#include "lights/solid_angle/projected_parallelogram.h"

#include <algorithm>
#include <cmath>

namespace stilb::lights {
namespace {

/// Newton's method ends with a step from an error below this, in shares of the whole: each step squares it.
constexpr double kLastError = 1e-6;

Vec3 normal_of(const Vec3& from, const Vec3& edge) {
    const Vec3 across = cross(from, edge);
    const double size = length(across);
    return size > 0 ? across / size : Vec3{};
}

double angle_between(const Vec3& from, const Vec3& edge) {
    return std::atan2(length(cross(from, edge)), dot(from, from + edge));
}

/// The x from 0 to 1 with value(x) = part, for an increasing function; slope(x) is its derivative.
template <typename Value, typename Slope>
double inverse(double start, double part, double whole, const Value& value, const Slope& slope) {
    double low = 0, high = 1, x = std::clamp(start, 0.0, 1.0);
    constexpr int most_steps = 60;
    for (int i = 0; i < most_steps; ++i) {
        const double excess = value(x) - part;
        (excess > 0 ? high : low) = x;
        const double step = -excess / slope(x);
        if (x + step >= low && x + step <= high) {
            x += step;
            if (std::abs(excess) <= kLastError * whole) break;
        } else {
            x = (low + high) / 2;
        }
    }
    return x;
}

/// The share at which a linear density with these ends reaches a share of its integral.
double inverse_of_linear(double at_start, double at_end, double share) {
    const double root = std::sqrt(at_start * at_start + share * (at_end * at_end - at_start * at_start));
    return at_start + root > 0 ? share * (at_start + at_end) / (at_start + root) : share;
}

}  // namespace

/// The density of projected solid angle along a line parallel to edge v, by its share t of the edge: height
/// times z over the fourth power of the distance, times the area.
class ProjectedParallelogram::Line {
  public:
    Line(const Vec3& start, const Vec3& edge, double factor) : length_(length(edge)), factor_(factor) {
        const Vec3 along = edge / length_;
        first_ = dot(start, along);
        const Vec3 aside = start - first_ * along;
        squared_ = squared_length(aside);
        distance_ = std::sqrt(squared_);
        aside_z_ = aside.z, along_z_ = along.z;
    }

    double density(double t) const {
        const double x = first_ + t * length_, squared = squared_ + x * x;
        return factor_ * (aside_z_ + x * along_z_) / (squared * squared);
    }
    /// From 0 to t.
    double integral(double t) const {
        const double x = first_ + t * length_;
        const double start = squared_ + first_ * first_, end = squared_ + x * x;
        const double angle = std::atan2(distance_ * (x - first_), squared_ + first_ * x);
        const double rational = x / end - first_ / start;
        return factor_ / (2 * length_) *
               (aside_z_ / squared_ * (rational + angle / distance_) + along_z_ * (1 / start - 1 / end));
    }

  private:
    double length_, factor_;
    double first_ = 0, squared_ = 0, distance_ = 0, aside_z_ = 0, along_z_ = 0;
};

ProjectedParallelogram::ProjectedParallelogram(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v)
    : corner_(corner), edge_u_(edge_u), edge_v_(edge_v) {
    const Vec3 front = cross(edge_u, edge_v);
    area_m2_ = length(front);
    height_m_ = -dot(corner, front) / area_m2_;
    first_side_sr_ = normal_of(corner, edge_v).z * angle_between(corner, edge_v);
    near_normal_ = normal_of(corner, edge_u);
    far_normal_ = normal_of(corner + edge_v, edge_u);
    whole_sr_ = strip_sr(1);
}

double ProjectedParallelogram::strip_sr(double share) const {
    const Vec3 edge = share * edge_u_, side = start(share);
    const double sides = first_side_sr_ - normal_of(side, edge_v_).z * angle_between(side, edge_v_);
    const double ends = far_normal_.z * angle_between(corner_ + edge_v_, edge) -
                        near_normal_.z * angle_between(corner_, edge);
    return std::max(0.0, (sides + ends) / 2);
}

ProjectedParallelogram::Shares ProjectedParallelogram::sample(double u1, double u2) const {
    const double factor = height_m_ * area_m2_;
    const auto line_at = [&](double u) { return Line(start(u), edge_v_, factor); };
    const auto density_at = [&](double u) { return line_at(u).integral(1); };
    const double u = inverse(
        inverse_of_linear(density_at(0), density_at(1), u1), u1 * whole_sr_, whole_sr_,
        [&](double x) { return strip_sr(x); }, density_at);
    const Line line = line_at(u);
    const double whole = line.integral(1);
    const double v = inverse(
        inverse_of_linear(line.density(0), line.density(1), u2), u2 * whole, whole,
        [&](double x) { return line.integral(x); }, [&](double x) { return line.density(x); });
    return {u, v};
}

}  // namespace stilb::lights
