// The colour of white light by its correlated colour temperature, and the way back.
#pragma once

#include "base/rgb.h"

namespace stilb::lights {

inline constexpr double kMinColourTemperature_k = 1000;
inline constexpr double kMaxColourTemperature_k = 25000;

/// Linear Rec. 709 colour of luminance 1 for a correlated colour temperature of 1000 to 25000 K (expected of
/// the caller). Up to 4000 K the Planckian radiator, from 5000 K daylight of the CIE, between them their
/// mixture in proportion, as in [IES TM-30-18]: lamps are made to match the two. Below about 1900 K the
/// colour lies outside of Rec. 709; its negative blue is cut to 0 and the luminance made 1 again.
Rgb colour_of_temperature(double temperature_k);

/// CIE 1960 (u, v), where distances from the colours of white light are stated [CIE 15].
struct ChromaticityUv {
    double u = 0, v = 0;
};

/// Of a colour with a luminance above 0.
ChromaticityUv chromaticity_of(const Rgb& colour);
/// Linear Rec. 709 of luminance 1; not cut to the gamut. v > 0.
Rgb colour_of(const ChromaticityUv& chromaticity);

/// The correlated colour temperature: that of the nearest colour_of_temperature().
struct CorrelatedTemperature {
    double temperature_k = 0;
    double distance = 0;  ///< to that colour, in CIE 1960 (u, v)
};

/// Of a colour with a luminance above 0; within 0.003 mired.
CorrelatedTemperature correlated_temperature(const Rgb& colour);

}  // namespace stilb::lights
