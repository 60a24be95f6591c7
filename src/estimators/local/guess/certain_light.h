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

    using Illuminances = std::array<PointTile::Floats, kBands>;  ///< of a tile's receivers [lx]
    /// The illuminances of receivers on surfaces, followed by the share of each channel in them.
    std::vector<Illuminances> illuminances_lx(const PointTile& tile) const;

  private:
    std::vector<patches::Float3> corners_;  ///< relative to the ray caster's centre
    std::vector<std::array<std::uint32_t, 3>>
        triangles_;                                      ///< of corners, clockwise as the receivers see them
    std::size_t sums_ = 1;                               ///< the whole and its shares
    std::vector<std::array<float, kBands>> luminances_;  ///< triangles x sums [cd/m2]
};

}  // namespace stilb::estimators
