// What lit patches send out, by whatever method.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "estimators/patch_light/patch_transport.h"

namespace stilb::estimators {

class PatchLight {
  public:
    virtual ~PatchLight() = default;

    /// The luminance [cd/m2] that a side reflects towards the unit `out`, in front of it, as a mean over the
    /// patch; without emission and without first shot.
    virtual Rgb reflected(std::uint32_t side, const Vec3& out) const = 0;
};

/// Sides that reflect the same luminance in all directions: what methods for diffuse scenes find.
class ReflectedSides final : public PatchLight {
  public:
    /// `cd_m2`: of every side.
    explicit ReflectedSides(std::vector<FloatRgb> cd_m2) : cd_m2_(std::move(cd_m2)) {}

    Rgb reflected(std::uint32_t side, const Vec3&) const override { return to_rgb(cd_m2_[side]); }
    const std::vector<FloatRgb>& cd_m2() const { return cd_m2_; }

  private:
    std::vector<FloatRgb> cd_m2_;
};

}  // namespace stilb::estimators
