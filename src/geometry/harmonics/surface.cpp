
#include "geometry/harmonics/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "math/first_root.h"
#include "math/gauss_legendre.h"
#include "stilb/error.h"

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
            "the radius of a surface by spherical harmonics is 0 or nearly 0 (its least value is "
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

/// The distance on one arm of the ray, measured from the closest point.
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
    const math::Sign at_start = math::sign_of(depth(from).first);
    const auto angle = math::first_root(depth, curvature, kNarrowest, from, to, at_start);
    if (!angle) return std::nullopt;
    return line.crossing(line.offset * std::tan(*angle), at_start == math::Sign::negative);
}

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

double ParallelGrid::phi(std::size_t k) const {
    return first_phi + kTurn * static_cast<double>(k) / static_cast<double>(azimuths);
}

Vec3 ParallelGrid::direction(std::size_t parallel, std::size_t k) const {
    const double radius = std::sqrt(1 - z[parallel] * z[parallel]);
    return {radius * std::cos(phi(k)), radius * std::sin(phi(k)), z[parallel]};
}

std::vector<Vec3> ParallelGrid::directions() const {
    std::vector<Vec3> all;
    all.reserve(size());
    for (std::size_t parallel = 0; parallel < parallels(); ++parallel) {
        for (std::size_t k = 0; k < azimuths; ++k) all.push_back(direction(parallel, k));
    }
    return all;
}

ParallelGrid gauss_grid(int parallels) {
    const math::GaussLegendre rule = math::gauss_legendre(parallels);
    ParallelGrid grid{rule.nodes, rule.weights, 2 * rule.nodes.size(), 0};
    for (double& weight : grid.weights_sr) weight *= kTurn / static_cast<double>(grid.azimuths);
    return grid;
}

ParallelGrid even_grid(int parallels) {
    const double step = std::numbers::pi / parallels;
    ParallelGrid grid{{}, {}, 2 * static_cast<std::size_t>(parallels), 0.5 * step};
    for (int i = 0; i < parallels; ++i) {
        const double north = std::cos(i * step), south = std::cos((i + 1) * step);
        grid.z.push_back(-std::cos((i + 0.5) * step));
        grid.weights_sr.push_back((north - south) * kTurn / static_cast<double>(grid.azimuths));
    }
    return grid;
}

namespace {

struct Angle {
    double cosine, sine;

    explicit Angle(double radians) : cosine(std::cos(radians)), sine(std::sin(radians)) {}
};

/// The angles of `count` equal steps in a turn.
double part_of_turn(double part, std::size_t count) { return kTurn * part / static_cast<double>(count); }

/// sum of cos(n angle) over |n| <= degree.
double dirichlet_kernel(std::size_t degree, double angle) {
    const double order = 2 * static_cast<double>(degree) + 1, half = std::remainder(angle, kTurn) / 2;
    return half == 0 ? order : std::sin(order * half) / std::sin(half);
}

}  // namespace

/// Directions are cos(e) (cos(a) e_k + sin(a) e_j) + sin(e) e_i. Samples are taken between the poles; beyond
/// a pole the circle continues on the opposite half.
MeridianSeries::MeridianSeries(const math::HarmonicSeries<double>& series, std::size_t i)
    : degree_(static_cast<std::size_t>(series.degree())) {
    const std::size_t half = degree_ + 1, count = 2 * half, j = (i + 1) % 3, k = (i + 2) % 3;
    const auto elevation = [&](std::size_t m) {
        return part_of_turn(static_cast<double>(m) + 0.5, count) - kTurn / 4;
    };
    std::vector<std::vector<double>> samples(count, std::vector<double>(half));
    for (std::size_t n = 0; n < count; ++n) {
        const Angle azimuth(part_of_turn(static_cast<double>(n), count));
        for (std::size_t m = 0; m < half; ++m) {
            const Angle e(elevation(m));
            std::array<double, 3> direction{};
            direction[i] = e.sine;
            direction[j] = e.cosine * azimuth.sine;
            direction[k] = e.cosine * azimuth.cosine;
            samples[n][m] = series.at({direction[0], direction[1], direction[2]});
        }
    }
    meridians_.assign(count, Meridian(half));
    for (std::size_t order = 0; order < half; ++order) {
        const double scale = (order == 0 ? 1. : 2.) / static_cast<double>(count);
        for (std::size_t m = 0; m < count; ++m) {
            const Angle angle(static_cast<double>(order) * elevation(m));
            for (std::size_t n = 0; n < count; ++n) {
                const double value = m < half ? samples[n][m] : samples[(n + half) % count][count - 1 - m];
                meridians_[n][order].cosine += scale * value * angle.cosine;
                meridians_[n][order].sine += scale * value * angle.sine;
            }
        }
    }
}

/// By the interpolating trigonometric polynomial.
MeridianSeries::Meridian MeridianSeries::meridian_at(double azimuth) const {
    const std::size_t count = meridians_.size();
    Meridian sum(degree_ + 1);
    for (std::size_t n = 0; n < count; ++n) {
        const double angle = azimuth - part_of_turn(static_cast<double>(n), count);
        const double weight = dirichlet_kernel(degree_, angle) / static_cast<double>(count);
        for (std::size_t order = 0; order <= degree_; ++order) {
            sum[order].cosine += weight * meridians_[n][order].cosine;
            sum[order].sine += weight * meridians_[n][order].sine;
        }
    }
    return sum;
}

/// Clenshaw's sums, in blocks that vectorise.
void MeridianSeries::evaluate(std::span<const double> s, double t, double z, std::span<double> values) const {
    constexpr std::size_t block = 16;
    using Block = std::array<double, block>;
    const Meridian meridian = meridian_at(std::atan2(t, z));
    const double across = std::sqrt(t * t + z * z);
    for (std::size_t first = 0; first < s.size(); first += block) {
        const std::size_t count = std::min(block, s.size() - first);
        Block cosine{}, sine{}, even{}, odd{}, even_before{}, odd_before{};
        for (std::size_t lane = 0; lane < count; ++lane) {
            const double length = std::sqrt(across * across + s[first + lane] * s[first + lane]);
            cosine[lane] = across / length;
            sine[lane] = s[first + lane] / length;
        }
        for (std::size_t order = degree_; order > 0; --order) {
            const auto [a, b] = meridian[order];
            for (std::size_t lane = 0; lane < block; ++lane) {
                const double twice = 2 * cosine[lane];
                const double next_even = a + twice * even[lane] - even_before[lane];
                const double next_odd = b + twice * odd[lane] - odd_before[lane];
                even_before[lane] = even[lane], even[lane] = next_even;
                odd_before[lane] = odd[lane], odd[lane] = next_odd;
            }
        }
        for (std::size_t lane = 0; lane < count; ++lane) {
            values[first + lane] =
                meridian[0].cosine + cosine[lane] * even[lane] - even_before[lane] + sine[lane] * odd[lane];
        }
    }
}

std::optional<HarmonicCrossing> march_crossing(const HarmonicSurface& surface, const Vec3& origin,
                                               const Vec3& direction, double start, double end, double step) {
    const double closest = -dot(origin, direction), radius = surface.greatest_radius();
    const double squared = radius * radius - squared_length(origin + closest * direction);
    if (squared <= 0) return std::nullopt;
    const auto is_outside = [&](double distance) {
        const Vec3 x = origin + distance * direction;
        const double from_origin = length(x);
        return from_origin > 0 && from_origin > surface.radius().at(x / from_origin);
    };
    const double reach = std::sqrt(squared);
    const double first = std::max(start, closest - reach), last = std::min(end, closest + reach);
    if (!(first < last)) return std::nullopt;
    const bool starts_outside = is_outside(first);
    const auto steps = static_cast<long>(std::ceil((last - first) / step));
    for (long i = 1; i <= steps; ++i) {
        double high = std::min(last, first + static_cast<double>(i) * step);
        if (is_outside(high) == starts_outside) continue;
        double low = first + static_cast<double>(i - 1) * step, middle = 0.5 * (low + high);
        for (; low < middle && middle < high; middle = 0.5 * (low + high)) {
            (is_outside(middle) == starts_outside ? low : high) = middle;
        }
        return HarmonicCrossing{high, normalized(origin + high * direction), starts_outside};
    }
    return std::nullopt;
}

}  // namespace stilb::geometry
