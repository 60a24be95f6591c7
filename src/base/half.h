// Half precision (16 bits, IEEE 754), for light that is stored: a relative error of at most 2^-11 between
// 6e-5 and 65504.
#pragma once

#include <array>
#include <cstdint>

#include "base/rgb.h"

namespace stilb {

using Half = std::uint16_t;
using HalfRgb = std::array<Half, kBands>;

/// The nearest value; beyond 65504 that value, not infinity.
Half to_half(float value);
float to_float(Half half);

HalfRgb to_half_rgb(const Rgb& rgb);
Rgb to_rgb(const HalfRgb& rgb);

}  // namespace stilb
