// Faces of a cube about the origin.
#pragma once

#include <array>
#include <cstddef>

#include "base/vec.h"

namespace stilb::geometry {

/// The axes (i, j, k) of a face and the sign of x_k.
struct CubeFace {
    std::size_t i, j, k;
    double sign;

    explicit CubeFace(std::size_t number)
        : i((number / 2 + 1) % 3), j((number / 2 + 2) % 3), k(number / 2), sign(number % 2 == 0 ? 1 : -1) {}

    /// (x_i, x_j, |x_k|).
    Vec3 to_local(const Vec3& x) const { return {x[i], x[j], sign * x[k]}; }
    Vec3 to_world(const Vec3& local) const {
        std::array<double, 3> x{};
        x[i] = local.x, x[j] = local.y, x[k] = sign * local.z;
        return {x[0], x[1], x[2]};
    }
};

}  // namespace stilb::geometry
