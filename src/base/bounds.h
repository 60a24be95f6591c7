// Axis-parallel bounding boxes.
#pragma once

#include <algorithm>
#include <limits>

#include "base/vec.h"

namespace stilb {

struct Bounds {
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vec3 min{kInfinity, kInfinity, kInfinity};
    Vec3 max{-kInfinity, -kInfinity, -kInfinity};

    constexpr bool is_empty() const { return min.x > max.x; }
    /// Half of the longest edge; 0 where there is nothing.
    constexpr double half_extent() const {
        return is_empty() ? 0 : std::max({max.x - min.x, max.y - min.y, max.z - min.z}) / 2;
    }
    constexpr void include(const Vec3& p) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
    }
};

}  // namespace stilb
