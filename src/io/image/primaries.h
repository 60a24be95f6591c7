// RGB by other primaries than Rec. 709.
#pragma once

#include <array>

namespace stilb::io {

using Triple = std::array<double, 3>;

/// CIE 1931 xy chromaticities of red, green, blue and white.
using Primaries = std::array<std::array<double, 2>, 4>;

inline constexpr Primaries kRec709{{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}};
/// Radiance's own, with equal-energy white: its programs weight with 0.265, 0.670, 0.065, which are these
/// primaries' shares of the luminance.
inline constexpr Primaries kRadiance{{{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, {1.0 / 3, 1.0 / 3}}};

/// Whether three colours with luminance make a basis, so that colours can be converted.
bool are_usable(const Primaries& primaries);

/// Converts linear RGB between primaries such that luminance is kept and white remains white: X and Z are
/// scaled to the new white point. Components below 0 are colours that the new primaries do not have.
class PrimariesConversion {
  public:
    /// Both must be usable.
    PrimariesConversion(const Primaries& from, const Primaries& to);
    Triple operator()(const Triple& rgb) const;

  private:
    std::array<Triple, 3> rows_;
};

}  // namespace stilb::io
