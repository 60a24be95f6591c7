#include "io/image/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stilb::io {
namespace {

/// Pieces by which the curve's length is measured: many per sample, so that steps come out equal to 1e-3.
constexpr std::size_t kPieces = 32 * (ColourMap::kSamples - 1);

struct Knot {
    double lightness, chroma, hue_degrees;
};

/// The knots of the curve: hues in one direction, chroma as strong as sRGB has it at that lightness.
constexpr std::array<Knot, 5> kKnots{{
    {0.13, 0.035, 280},
    {0.34, 0.155, 290},
    {0.55, 0.200, 358},
    {0.76, 0.150, 60},
    {0.97, 0.070, 105},
}};

Oklab to_oklab(const Knot& knot) {
    const double hue = knot.hue_degrees * std::numbers::pi / 180;
    return {knot.lightness, knot.chroma * std::cos(hue), knot.chroma * std::sin(hue)};
}

Oklab combine(double s, const Oklab& x, double t, const Oklab& y) {
    return {s * x.lightness + t * y.lightness, s * x.a + t * y.a, s * x.b + t * y.b};
}

/// Cubic through the knots (Catmull-Rom; straight beyond the ends), parameter 0 to 1.
Oklab curve_at(double parameter) {
    const double place = parameter * (kKnots.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), kKnots.size() - 2);
    const double t = place - static_cast<double>(i);
    const Oklab from = to_oklab(kKnots[i]);
    const Oklab to = to_oklab(kKnots[i + 1]);
    const Oklab before = i > 0 ? to_oklab(kKnots[i - 1]) : combine(2, from, -1, to);
    const Oklab after = i + 2 < kKnots.size() ? to_oklab(kKnots[i + 2]) : combine(2, to, -1, from);
    const Oklab ends = combine((1 + 2 * t) * (1 - t) * (1 - t), from, t * t * (3 - 2 * t), to);
    const double leave = t * (1 - t) * (1 - t) / 2;
    const double arrive = t * t * (t - 1) / 2;
    const Oklab slopes = combine(leave, combine(1, to, -1, before), arrive, combine(1, after, -1, from));
    return combine(1, ends, 1, slopes);
}

}  // namespace

ColourMap::ColourMap() {
    std::vector<Oklab> points(kPieces + 1);
    std::vector<double> length(kPieces + 1);
    for (std::size_t i = 0; i <= kPieces; ++i) {
        points[i] = curve_at(static_cast<double>(i) / kPieces);
        if (i > 0) length[i] = length[i - 1] + distance(points[i - 1], points[i]);
    }
    std::size_t i = 0;
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
        const double wanted = length.back() * static_cast<double>(sample) / (kSamples - 1);
        while (i + 2 < length.size() && length[i + 1] < wanted) ++i;
        const double t = (wanted - length[i]) / (length[i + 1] - length[i]);
        samples_.push_back(combine(1 - t, points[i], t, points[i + 1]));
    }
}

Colour ColourMap::at(double fraction) const {
    const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(samples_.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), samples_.size() - 2);
    const double t = place - static_cast<double>(i);
    return from_oklab(combine(1 - t, samples_[i], t, samples_[i + 1]));
}

}  // namespace stilb::io
