// Tone reproduction: from luminances to the range of a display.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "io/image/picture.h"
#include "io/image/white_balance.h"
#include "scene/whites.h"

namespace stilb::io {

// Colours for drawing, and OKLab, in which equal distances look equally different.

/// sRGB, gamma-encoded, 0 to 1; alpha 1 is opaque.
struct Colour {
    double red = 0, green = 0, blue = 0, alpha = 1;
};

constexpr Colour grey(double level) { return {level, level, level, 1}; }
constexpr Colour with_alpha(Colour colour, double alpha) {
    colour.alpha = alpha;
    return colour;
}

/// 0 to 255, without the alpha; components outside of 0 to 1 are cut off.
std::array<std::uint8_t, 3> bytes_of(const Colour& colour);

/// [Ottosson 2020, A perceptual color space for image processing]: lightness 0 (black) to 1 (white).
struct Oklab {
    double lightness = 0, a = 0, b = 0;
};

Oklab to_oklab(const Colour& colour);

/// Components may leave 0 to 1 where sRGB cannot represent the colour.
Colour from_oklab(const Oklab& colour);

double distance(const Oklab& first, const Oklab& second);

/// Black or white, whichever has more contrast with `background` [W3C, WCAG 2.1]; at least 4.5 : 1.
Colour readable_on(const Colour& background);

// The way of a luminance picture to the screen: white balance, exposure, tone curve.

struct ToneOptions {
    /// The exposure per cd/m2: luminance times exposure is what the tone curve shows. Chosen from the
    /// picture where absent.
    std::optional<double> exposure;
    /// The white of the picture, chosen between these two colours by choose_white().
    scene::WhiteRange white{};
};

/// Luminance times exposure x is shown as it is up to 0.5. Above, a shoulder without a kink leads to white
/// at x = 8: Reinhard's global operator [Reinhard et al. 2002, Photographic tone reproduction for digital
/// images, eq. 4] for what exceeds 0.5. So all but the bright parts keep their contrasts, and lamps still
/// differ from what they light. Colours are adapted to the white (white_balance.h); the luminance stays. A
/// colour outside of the display's gamut is mixed with grey of the same luminance: overexposed colours tend
/// to white.
class ToneCurve {
  public:
    /// `white`: what is shown without hue. Throws InputError where the exposure is not a finite number above
    /// 0.
    explicit ToneCurve(double exposure, const Rgb& white = Rgb::grey(1));

    double exposure() const { return exposure_; }
    const Rgb& white() const { return white_; }
    /// A description such as "linear to 0.5 / exposure, then Reinhard 2002, white at 8 / exposure".
    std::string description() const;
    /// The correlated colour temperature of the white [K].
    double white_k() const;

    /// Display luminance, 0 to 1; monotonic; 0 for negative values and for NaN.
    double display_luminance(double luminance_cd_m2) const;
    /// The sRGB colour. A pixel without value is black.
    std::array<std::uint8_t, 3> srgb(const std::array<float, 3>& rgb_cd_m2) const;

  private:
    double exposure_;
    Rgb white_;
    ChromaticAdaptation adapted_;
};

/// The exposure that makes nine tenths of the pixels no brighter than 0.65. The median then must lie between
/// 0.12 and 0.36, so that neither bright lamps and windows nor their absence decide over the
/// room; but nine tenths of the pixels must not exceed 4, so that few bright things in the dark keep their
/// contrasts. 1 for a black picture.
double automatic_exposure(const Picture& picture);

/// By the options, with an automatic exposure where they have none.
ToneCurve tone_curve_for(const Picture& picture, const ToneOptions& options);

// RGB with primaries other than Rec. 709.

using Triple = std::array<double, 3>;

/// CIE 1931 xy chromaticities of red, green, blue and white.
using Primaries = std::array<std::array<double, 2>, 4>;

inline constexpr Primaries kRec709{{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}};
/// Radiance's own primaries, with equal-energy white: its programs weight with 0.265, 0.670, 0.065, which are
/// these primaries' shares of the luminance.
inline constexpr Primaries kRadiance{{{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, {1.0 / 3, 1.0 / 3}}};

/// Whether the three primaries span a colour space, so that colours can be converted.
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
