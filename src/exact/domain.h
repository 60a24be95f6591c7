// Checks of arguments against a solution's domain.
#pragma once

#include <cmath>
#include <stdexcept>

#include "base/vec.h"

namespace stilb::exact {

/// Throws std::domain_error with `message` unless `holds`. Write conditions so that NaN makes them false.
inline void require(bool holds, const char* message) {
    if (!holds) throw std::domain_error(message);
}

inline void require_not_negative(double value, const char* message) {
    require(value >= 0 && std::isfinite(value), message);
}

inline void require_positive(double value, const char* message) {
    require(value > 0 && std::isfinite(value), message);
}

/// `direction` with length 1; `message` says which direction is zero or not finite.
inline Vec3 require_direction(const Vec3& direction, const char* message) {
    const double norm = std::hypot(direction.x, direction.y, direction.z);
    require_positive(norm, message);
    return direction / norm;
}

}  // namespace stilb::exact
