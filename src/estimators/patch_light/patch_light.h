// What lit patches send out, by whatever method.
#pragma once

#include <cstdint>

#include "base/rgb.h"
#include "base/vec.h"

namespace stilb::estimators {

class PatchLight {
  public:
    virtual ~PatchLight() = default;

    /// The luminance [cd/m2] that a side reflects towards the unit `out`, in front of it, as a mean over the
    /// patch; without emission and without first shot.
    virtual Rgb reflected(std::uint32_t side, const Vec3& out) const = 0;
};

}  // namespace stilb::estimators
