// Bands: three linear Rec. 709 channels, each carrying its share of a photometric quantity. Luminance (and
// illuminance, flux ...) is the fixed dot product luminance(). A grey quantity q is Rgb::grey(q).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace stilb {

inline constexpr std::size_t kBands = 3;
/// Rec. 709 luminance weights; they add up to 1.
inline constexpr std::array<double, kBands> kLuminanceWeights{0.2126, 0.7152, 0.0722};

struct Rgb {
    std::array<double, kBands> band{};

    static constexpr Rgb grey(double value) { return {{value, value, value}}; }

    constexpr double operator[](std::size_t b) const { return band[b]; }
    constexpr double& operator[](std::size_t b) { return band[b]; }
    constexpr Rgb& operator+=(const Rgb& o) {
        for (std::size_t b = 0; b < kBands; ++b) band[b] += o.band[b];
        return *this;
    }
    constexpr Rgb& operator*=(const Rgb& o) {
        for (std::size_t b = 0; b < kBands; ++b) band[b] *= o.band[b];
        return *this;
    }
    constexpr Rgb& operator*=(double s) {
        for (double& value : band) value *= s;
        return *this;
    }
    constexpr bool operator==(const Rgb&) const = default;

    constexpr double luminance() const {
        return kLuminanceWeights[0] * band[0] + kLuminanceWeights[1] * band[1] +
               kLuminanceWeights[2] * band[2];
    }
    constexpr double max() const { return std::max({band[0], band[1], band[2]}); }
    constexpr double min() const { return std::min({band[0], band[1], band[2]}); }
    bool is_finite() const {
        return std::isfinite(band[0]) && std::isfinite(band[1]) && std::isfinite(band[2]);
    }
};

constexpr Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
constexpr Rgb operator*(Rgb a, const Rgb& b) { return a *= b; }
constexpr Rgb operator*(Rgb a, double s) { return a *= s; }
constexpr Rgb operator*(double s, Rgb a) { return a *= s; }

}  // namespace stilb
