#include "base/half.h"

#include <Imath/half.h>

#include <algorithm>

namespace stilb {

Half to_half(float value) {
    constexpr float largest = 65504;
    return imath_float_to_half(std::clamp(value, -largest, largest));
}
float to_float(Half half) { return imath_half_to_float(half); }

HalfRgb to_half_rgb(const Rgb& rgb) {
    return {to_half(static_cast<float>(rgb[0])), to_half(static_cast<float>(rgb[1])),
            to_half(static_cast<float>(rgb[2]))};
}
Rgb to_rgb(const HalfRgb& rgb) { return {{to_float(rgb[0]), to_float(rgb[1]), to_float(rgb[2])}}; }

}  // namespace stilb
