// From luminances to what a screen can show.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "io/image/picture.h"

namespace stilb::io {

struct ToneOptions {
    /// Per cd/m2: a luminance of 0.18 / exposure becomes middle grey. Chosen from the picture where absent.
    std::optional<double> exposure;
};

/// Luminance times exposure goes through the curve L (1 + L / W^2) / (1 + L) with W = 8 (Reinhard's global
/// operator [Reinhard et al. 2002, Photographic tone reproduction for digital images, eq. 4]): nearly linear
/// in the dark, and white from W on. Hue and saturation stay, but where the screen lacks the colour it is
/// mixed with grey of the same luminance: what is too bright goes to white.
class ToneCurve {
  public:
    /// Throws InputError where the exposure is not a finite number above 0.
    explicit ToneCurve(double exposure);

    double exposure() const { return exposure_; }
    /// Such as "Reinhard 2002, white at 8 / exposure".
    std::string description() const;

    /// Display luminance, 0 to 1; does not decrease; 0 below 0 and for NaN.
    double display_luminance(double luminance_cd_m2) const;
    /// sRGB. A pixel without value is black.
    std::array<std::uint8_t, 3> srgb(const std::array<float, 3>& rgb_cd_m2) const;

  private:
    double exposure_;
};

/// Makes the luminances' geometric mean middle grey, 0.18, but less where more than one pixel in a hundred
/// would be white by that, down to a quarter. 1 for a black picture.
double automatic_exposure(const Picture& picture);

}  // namespace stilb::io
