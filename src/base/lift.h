// How far points are lifted off their surfaces, so that rays from there do not meet these again.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace stilb {

/// Ray queries work in single precision on coordinates relative to a centre: 2^-19 of the largest number
/// involved is some 30 times the rounding error.
class Lift {
  public:
    Lift() = default;
    /// Of a scene with this centre of its bounding box, and half of the box's longest edge.
    Lift(const Vec3& center, double half_extent_m) : center_(center), half_extent_m_(half_extent_m) {}

    const Vec3& center() const { return center_; }
    double half_extent_m() const { return half_extent_m_; }
    /// How far a point near `position` on something of size `size_m` is lifted.
    double offset_m(const Vec3& position, double size_m) const {
        return relative_offset_m(position - center_, size_m);
    }
    /// The same for a position relative to the centre.
    static double relative_offset_m(const Vec3& relative, double size_m) {
        constexpr double share = 0x1p-19;
        return share * std::max({std::abs(relative.x), std::abs(relative.y), std::abs(relative.z), size_m});
    }

  private:
    Vec3 center_;
    double half_extent_m_ = 0;
};

}  // namespace stilb
