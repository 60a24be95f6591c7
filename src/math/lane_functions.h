// Functions in single precision without branches, so that loops over the lanes of packets vectorise.
// Polynomials are least in their largest error, which is below the rounding of a float.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "base/rays.h"

namespace stilb::math {

struct SineCosine {
    float sin = 0, cos = 0;
};

/// For |x| <= pi/2.
STILB_INLINED SineCosine lane_sine_cosine(float x) {
    const float s = x * x;
    const float sine =
        1 + s * (-0.166666666f + s * (0.00833333098f +
                                      s * (-0.000198408619f + s * (2.75253044e-06f + s * -2.38897787e-08f))));
    const float cosine =
        1 + s * (-0.499999994f +
                 s * (0.0416666363f + s * (-0.00138883614f + s * (2.47601613e-05f + s * -2.6051495e-07f))));
    return {x * sine, cosine};
}

/// As std::atan2; 0 where both are 0.
STILB_INLINED float lane_atan2(float y, float x) {
    const float ax = std::abs(x), ay = std::abs(y);
    const float larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
    const float q = larger > 0 ? smaller / larger : 0;
    const float s = q * q;
    const float arc =
        q * (0.999999986f +
             s * (-0.333330939f +
                  s * (0.199930538f +
                       s * (-0.142071315f +
                            s * (0.106546688f +
                                 s * (-0.0753365742f +
                                      s * (0.0430391448f + s * (-0.0162828693f + s * 0.00290351752f))))))));
    constexpr auto pi = std::numbers::pi_v<float>;
    const float first_octant = ay > ax ? pi / 2 - arc : arc;
    return std::copysign(x < 0 ? pi - first_octant : first_octant, y);
}

/// As sample_unit_disk().
STILB_INLINED std::array<float, 2> lane_unit_disk(float u1, float u2) {
    const float a = 2 * u1 - 1, b = 2 * u2 - 1;
    const bool left_or_right = std::abs(a) > std::abs(b);
    const float radius = left_or_right ? a : b, other = left_or_right ? b : a;
    const float angle = radius != 0 ? std::numbers::pi_v<float> / 4 * (other / radius) : 0;
    const SineCosine part = lane_sine_cosine(angle);
    const float along = radius * part.cos, across = radius * part.sin;
    return {left_or_right ? along : across, left_or_right ? across : along};
}

}  // namespace stilb::math
