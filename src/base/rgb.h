// Bands: three linear Rec. 709 channels, each carrying its share of a photometric quantity. Luminance (and
// illuminance, flux ...) is the fixed dot product luminance(). A grey quantity q is Spectrum::grey(q).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace stilb {

inline constexpr std::size_t kBands = 3;
/// Rec. 709 luminance weights; they add up to 1.
inline constexpr std::array<double, kBands> kLuminanceWeights{0.2126, 0.7152, 0.0722};

struct Spectrum {
    std::array<double, kBands> band{};

    static constexpr Spectrum grey(double value) { return {{value, value, value}}; }

    constexpr double operator[](std::size_t b) const { return band[b]; }
    constexpr double& operator[](std::size_t b) { return band[b]; }
    constexpr Spectrum& operator+=(const Spectrum& o) {
        for (std::size_t b = 0; b < kBands; ++b) band[b] += o.band[b];
        return *this;
    }
    constexpr Spectrum& operator*=(const Spectrum& o) {
        for (std::size_t b = 0; b < kBands; ++b) band[b] *= o.band[b];
        return *this;
    }
    constexpr Spectrum& operator*=(double s) {
        for (double& value : band) value *= s;
        return *this;
    }
    constexpr bool operator==(const Spectrum&) const = default;

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

constexpr Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
constexpr Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
constexpr Spectrum operator*(Spectrum a, double s) { return a *= s; }
constexpr Spectrum operator*(double s, Spectrum a) { return a *= s; }

}  // namespace stilb
