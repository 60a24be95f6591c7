#include "geometry/harmonics/meridian_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stilb::geometry {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct Angle {
    double cosine, sine;

    explicit Angle(double radians) : cosine(std::cos(radians)), sine(std::sin(radians)) {}
};

/// Of `count` in a turn.
double part_of_turn(double part, std::size_t count) { return kTurn * part / static_cast<double>(count); }

/// sum of cos(n angle) over |n| <= degree.
double dirichlet_kernel(std::size_t degree, double angle) {
    const double order = 2 * static_cast<double>(degree) + 1, half = std::remainder(angle, kTurn) / 2;
    return half == 0 ? order : std::sin(order * half) / std::sin(half);
}

}  // namespace

/// Directions are cos(e) (cos(a) e_k + sin(a) e_j) + sin(e) e_i. Samples are taken between the poles; beyond
/// a pole the circle goes on on the opposite half.
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

}  // namespace stilb::geometry
