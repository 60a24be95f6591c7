// The units of Radiance: W/(sr m2) in three bands, and luminance by its own efficacy and weights.
#pragma once

#include "base/rgb.h"

namespace stilb::io {

/// Luminance over radiance of Radiance's white [lm/W].
inline constexpr double kRadianceEfficacy_lm_w = 179;
/// The weights of Radiance's red, green and blue in the luminance.
inline constexpr std::array<double, kBands> kRadianceWeights{0.265, 0.670, 0.065};

/// From a radiance to a luminance [cd/m2] (or from an irradiance to an illuminance), band by band, such that
/// the luminance is exactly 179 (0.265 R + 0.670 G + 0.065 B). As each band has a factor of its own and light
/// is computed band by band, results can be converted back exactly.
constexpr Rgb photometric(const Rgb& radiometric) {
    Rgb result;
    for (std::size_t b = 0; b < kBands; ++b)
        result[b] = radiometric[b] * kRadianceEfficacy_lm_w * kRadianceWeights[b] / kLuminanceWeights[b];
    return result;
}
/// The inverse.
constexpr Rgb radiometric(const Rgb& photometric) {
    Rgb result;
    for (std::size_t b = 0; b < kBands; ++b)
        result[b] = photometric[b] * kLuminanceWeights[b] / (kRadianceWeights[b] * kRadianceEfficacy_lm_w);
    return result;
}

}  // namespace stilb::io
