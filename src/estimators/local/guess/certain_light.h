// Light that a group of receivers gets from the sides which it sees for certain (certain_sides.h), in closed
// form: Lambert's formula for triangles of uniform luminance, of what is above the horizon.
//
// The luminance of a side is not uniform. The closed form takes its mean, and gathering rays bring the
// difference from the mean where they meet the side: some per cent of the light, of either sign.
//
// Exact but for rounding in single precision, about 1e-6 of the light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "estimators/local/guess/certain_sides.h"
#include "estimators/local/guess/light_guess.h"
#include "estimators/local/point_tile.h"

namespace stilb::estimators {

class CertainLight {
  public:
    CertainLight(const LightGuess& guess, const Sights& sights);

    /// The illuminances of a tile's receivers, which are on surfaces [lx].
    std::array<PointTile::Floats, kBands> illuminances_lx(const PointTile& tile) const;

  private:
    struct Triangle {
        std::array<std::uint32_t, 3> corners;  ///< of `corners_`, clockwise as the receivers see them
        std::array<float, kBands> luminance;   ///< [cd/m2]
    };
    std::vector<patches::Float3> corners_;  ///< relative to the ray caster's centre
    std::vector<Triangle> triangles_;
};

}  // namespace stilb::estimators
