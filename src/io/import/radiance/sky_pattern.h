// The brightness of skies by direction, as gensky and gendaylit state it: the functions of skybright.cal and
// perezlum.cal of Radiance.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "io/import/radiance/description.h"

namespace stilb::io::radiance {

/// A brightfunc of a sky. Immutable.
class SkyPattern {
  public:
    /// Nothing where the modifier has another function. Throws InputError with file and line where the
    /// numbers or the transforms of a sky are wrong.
    static std::optional<SkyPattern> read(const Modifier& modifier, const Description& description);

    /// The factor of the radiance, at least 0. `direction`: a unit vector towards the sky.
    double factor(const Vec3& direction) const;

  private:
    class Reader;
    enum class Sky { clear, overcast, uniform, intermediate, perez };

    /// The factor of the sky alone, which goes on below the horizon.
    double above_horizon(double z, double to_sun_cosine) const;

    Sky sky_ = Sky::uniform;
    double zenith_ = 0, ground_ = 0;
    double normalization_ = 1;              ///< divides clear and intermediate skies
    std::array<double, 5> coefficients_{};  ///< a to e of Perez
    Vec3 sun_;
    Vec3 x_axis_, y_axis_, z_axis_;  ///< of its coordinates in those of the scene, unit vectors
};

}  // namespace stilb::io::radiance
