#include "lights/colour_temperature.h"

#include <algorithm>
#include <cmath>

namespace stilb::lights {
namespace {

constexpr double kPlanckianUpTo_k = 4000;
constexpr double kDaylightFrom_k = 5000;

/// CIE 1931.
struct Chromaticity {
    double x = 0, y = 0;
};

/// [Krystek 1985, An algorithm to calculate correlated colour temperature]: rational approximation in CIE
/// 1960 (u, v), within 1e-4 from 1000 to 15000 K.
Chromaticity planckian_chromaticity(double t) {
    const double u = (0.860117757 + t * (1.54118254e-4 + t * 1.28641212e-7)) /
                     (1 + t * (8.42420235e-4 + t * 7.08145163e-7));
    const double v = (0.317398726 + t * (4.22806245e-5 + t * 4.20481691e-8)) /
                     (1 + t * (-2.89741816e-5 + t * 1.61456053e-7));
    const double scale = 1 / (2 * u - 8 * v + 4);
    return {3 * u * scale, 2 * v * scale};
}

/// [CIE 15, daylight illuminants], stated for 4000 to 25000 K.
Chromaticity daylight_chromaticity(double t) {
    const double r = 1000 / t;
    const double x = t <= 7000 ? 0.244063 + r * (0.09911 + r * (2.9678 - r * 4.6070))
                               : 0.237040 + r * (0.24748 + r * (1.9018 - r * 2.0064));
    return {x, -0.275 + x * (2.870 - x * 3.000)};
}

/// XYZ of luminance 1 to linear Rec. 709 [IEC 61966-2-1].
Rgb to_rec709(const Chromaticity& c) {
    const double x = c.x / c.y;
    const double z = (1 - c.x - c.y) / c.y;
    return {{3.2406 * x - 1.5372 - 0.4986 * z, -0.9689 * x + 1.8758 + 0.0415 * z,
             0.0557 * x - 0.2040 + 1.0570 * z}};
}

/// Cut to the gamut, luminance 1.
Rgb unit_luminance_colour(const Chromaticity& c) {
    Rgb rgb = to_rec709(c);
    for (double& value : rgb.band) value = std::max(value, 0.0);
    return rgb * (1 / rgb.luminance());
}

}  // namespace

Rgb colour_of_temperature(double temperature_k) {
    const double daylight_share =
        std::clamp((temperature_k - kPlanckianUpTo_k) / (kDaylightFrom_k - kPlanckianUpTo_k), 0.0, 1.0);
    Rgb colour;
    if (daylight_share < 1) {
        colour += (1 - daylight_share) * unit_luminance_colour(planckian_chromaticity(temperature_k));
    }
    if (daylight_share > 0) {
        colour += daylight_share * unit_luminance_colour(daylight_chromaticity(temperature_k));
    }
    return colour;
}

ChromaticityUv chromaticity_of(const Rgb& colour) {
    // Linear Rec. 709 to XYZ [IEC 61966-2-1].
    const double x = 0.4124 * colour[0] + 0.3576 * colour[1] + 0.1805 * colour[2];
    const double y = colour.luminance();
    const double z = 0.0193 * colour[0] + 0.1192 * colour[1] + 0.9505 * colour[2];
    const double sum = x + 15 * y + 3 * z;
    return {4 * x / sum, 6 * y / sum};
}

Rgb colour_of(const ChromaticityUv& chromaticity) {
    const auto [u, v] = chromaticity;
    const double scale = 1 / (2 * u - 8 * v + 4);
    const Rgb rgb = to_rec709({3 * u * scale, 2 * v * scale});
    return rgb * (1 / rgb.luminance());
}

namespace {

/// The distance of a chromaticity to the colour of white light at a reciprocal temperature in mired.
double distance_at(double mired, const ChromaticityUv& from) {
    const ChromaticityUv white = chromaticity_of(colour_of_temperature(1e6 / mired));
    return std::hypot(white.u - from.u, white.v - from.v);
}

}  // namespace

CorrelatedTemperature correlated_temperature(const Rgb& colour) {
    const ChromaticityUv from = chromaticity_of(colour);
    constexpr double kLeastMired = 1e6 / kMaxColourTemperature_k;
    constexpr double kMostMired = 1e6 / kMinColourTemperature_k;
    double first = kLeastMired, last = kMostMired, best = first;
    for (double step = 8; step > 0.001; step /= 8) {
        for (double mired = first; mired <= last; mired += step) {
            if (distance_at(mired, from) < distance_at(best, from)) best = mired;
        }
        first = std::max(best - step, kLeastMired);
        last = std::min(best + step, kMostMired);
    }
    return {1e6 / best, distance_at(best, from)};
}

}  // namespace stilb::lights
