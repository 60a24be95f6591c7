// Luminance distributions of skies: those of the CIE, and that of Perez.
#pragma once

#include <array>

#include "base/vec.h"

namespace stilb::lights {

enum class SkyType { clear, overcast, uniform, intermediate, perez };

inline bool depends_on_sun(SkyType type) { return type != SkyType::overcast && type != SkyType::uniform; }

struct SkyLuminance {
    SkyType type = SkyType::uniform;
    double zenith = 0;              ///< the luminance of the zenith; of perez the factor of its formula
    Vec3 sun;                       ///< unit, towards it, where the sky depends on it
    double zenith_value = 1;        ///< of the formula of a clear or an intermediate sky, which it divides
    std::array<double, 5> perez{};  ///< its coefficients a to e

    /// The luminance from a unit vector, z upwards, in the unit of `zenith`. The formulas go on below the
    /// horizon, and need not be above 0 there.
    double towards(const Vec3& direction) const;
};

// The CIE's formulas for skies. Altitudes of the sun are in radians.

/// The luminance of the zenith. `turbidity`: Linke's, of the air of a clear sky.
double zenith_luminance_cd_m2(SkyType type, double sun_altitude, double turbidity);
/// SkyLuminance::zenith_value.
double zenith_value(SkyType type, double sun_altitude);
/// The horizontal illuminance by the sky over that of a uniform sky of the zenith's luminance.
double mean_over_zenith(SkyType type, double sun_altitude);
/// The luminance of the sun as a disk of half a degree. `sun_altitude`: above 0.
double sun_luminance_cd_m2(SkyType type, double sun_altitude);

}  // namespace stilb::lights
