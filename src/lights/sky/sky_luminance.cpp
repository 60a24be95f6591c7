// The formulas and their constants are those of Radiance's gensky, skybright.cal and perezlum.cal.
#include "lights/sky/sky_luminance.h"

#include <algorithm>
#include <cmath>

namespace stilb::lights {
namespace {

double angle_of_cosine(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

/// CIE, after Kittler.
double clear_sky(double z, double to_sun_cosine) {
    const double circumsolar =
        0.91 + 10 * std::exp(-3 * angle_of_cosine(to_sun_cosine)) + 0.45 * to_sun_cosine * to_sun_cosine;
    return circumsolar * (z > 0.01 ? 1 - std::exp(-0.32 / z) : 1);
}

/// After Matsuura.
double intermediate_sky(double z, double to_sun_cosine, double sun_z) {
    const double from_zenith = angle_of_cosine(z), of_sun = angle_of_cosine(sun_z);
    const double height =
        (1.35 * std::sin(5.631 - 3.59 * from_zenith) + 3.12) * std::sin(4.396 - 2.6 * of_sun) + 6.37 -
        from_zenith;
    return height / 2.326 *
           std::exp(-0.563 * angle_of_cosine(to_sun_cosine) *
                    ((2.629 - from_zenith) * (1.562 - of_sun) + 0.812));
}

double perez_sky(double z, double to_sun_cosine, const std::array<double, 5>& coefficients) {
    const auto& [a, b, c, d, e] = coefficients;
    return (1 + a * std::exp(b / std::max(z, 0.01))) *
           (1 + c * std::exp(d * angle_of_cosine(to_sun_cosine)) + e * to_sun_cosine * to_sun_cosine);
}

}  // namespace

double SkyLuminance::towards(const Vec3& direction) const {
    const double z = direction.z, to_sun_cosine = dot(direction, sun);
    switch (type) {
        case SkyType::clear:
            return zenith * clear_sky(z, to_sun_cosine) / zenith_value;
        case SkyType::overcast:  // CIE, after Moon and Spencer
            return zenith * (1 + 2 * z) / 3;
        case SkyType::uniform:
            return zenith;
        case SkyType::intermediate:
            return zenith * intermediate_sky(z, to_sun_cosine, sun.z) / zenith_value;
        case SkyType::perez:
            break;
    }
    return zenith * perez_sky(z, to_sun_cosine, perez);
}

double zenith_luminance_cd_m2(SkyType type, double sun_altitude, double turbidity) {
    const double overcast = 8.6 * std::sin(sun_altitude) + 0.123;                     // Krochmann
    const double clear = (1.376 * turbidity - 1.81) * std::tan(sun_altitude) + 0.38;  // Karayel et al.
    double kcd_m2 = overcast;
    if (type == SkyType::clear) kcd_m2 = clear;
    if (type == SkyType::intermediate) kcd_m2 = (clear + overcast) / 2;
    return std::max(kcd_m2, 0.0) * 1000;
}

double zenith_value(SkyType type, double sun_altitude) {
    const double from_zenith = kPi / 2 - sun_altitude, sine = std::sin(sun_altitude);
    if (type == SkyType::clear) return 0.274 * (0.91 + 10 * std::exp(-3 * from_zenith) + 0.45 * sine * sine);
    if (type == SkyType::intermediate) {
        return (2.739 + 0.9891 * std::sin(0.3119 + 2.6 * sun_altitude)) *
               std::exp(-from_zenith * (0.4441 + 1.48 * sun_altitude));
    }
    return 1;
}

double mean_over_zenith(SkyType type, double sun_altitude) {
    constexpr std::array clear{2.766521, 0.547665, -0.369832, 0.009237, 0.059229};
    constexpr std::array intermediate{3.5556, -2.7152, -1.3081, 1.0660, 0.60227};
    if (type == SkyType::uniform) return 1;
    if (type == SkyType::overcast) return 7.0 / 9;
    const auto& coefficients = type == SkyType::clear ? clear : intermediate;
    const double x = (sun_altitude - kPi / 4) / (kPi / 4);
    double sum = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
    return sum / zenith_value(type, sun_altitude) / kPi;
}

double sun_luminance_cd_m2(SkyType type, double sun_altitude) {
    const double clear = 1.5e9 * (1.147 - 0.147 / std::max(std::sin(sun_altitude), 0.16));
    return type == SkyType::intermediate ? 0.15 * clear : clear;
}

}  // namespace stilb::lights
