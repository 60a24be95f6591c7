// The brightness of skies by direction, as gensky and gendaylit state it: the functions of skybright.cal and
// perezlum.cal of Radiance.
#pragma once

#include <array>
#include <optional>

#include "io/import/radiance/description.h"
#include "lights/sky/sky_luminance.h"

namespace stilb::io::radiance {

/// The skies of skybright.cal, by their number from 1.
inline constexpr std::array kSkiesOfGensky{lights::SkyType::clear, lights::SkyType::overcast,
                                           lights::SkyType::uniform, lights::SkyType::intermediate};

/// A brightfunc of a sky above a ground of constant brightness.
struct SkyPattern {
    lights::SkyLuminance sky;
    double ground = 0;
    Frame axes;  ///< of its coordinates in those of the scene

    /// The factor of the radiance, at least 0. `direction`: a unit vector towards the sky.
    double factor(const Vec3& direction) const;
};

/// Nothing where the modifier has another function. Throws InputError with file and line where the numbers or
/// the transforms of a sky are wrong.
std::optional<SkyPattern> read_sky_pattern(const Modifier& modifier, const Description& description);

}  // namespace stilb::io::radiance
