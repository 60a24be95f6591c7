// Points where light arrives, or that it leaves.
#pragma once

#include "base/vec.h"

namespace stilb {

/// A point on a side of a surface, or in the open, where light arrives from all directions.
struct SurfacePoint {
    Vec3 position;
    Vec3 normal{};           ///< unit, on that side; 0 in the open
    Vec3 lifted = position;  ///< off the surface on that side: rays start and end here

    bool is_in_open() const { return normal == Vec3{}; }
};

}  // namespace stilb
