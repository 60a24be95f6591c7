// Diffuse first shot: the part of the reflection that is the same in all directions is stored, one colour for
// each side, and the rest found by shadow rays.
#pragma once

#include <span>
#include <vector>

#include "estimators/patch_light/first_shot/incoming.h"
#include "estimators/patch_light/first_shot/shadow_rays.h"
#include "math/random.h"

namespace stilb::estimators {

/// Keeps references to scene and patches, and those of the shadow rays.
class DiffuseFirstShot {
  public:
    DiffuseFirstShot(const Scene& scene, const patches::Patches& patches, const IncomingFirstShot& incoming,
                     const ShadowRays& rays);

    /// As FirstShot; the position matters to the rest.
    void add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                       std::span<const Vec3> outs, std::span<Rgb> sums) const;
    bool is_constant(std::uint32_t side) const { return reflects_alike(material_of(scene_, patches_, side)); }
    std::size_t bytes() const { return radiance_cd_m2_.size() * sizeof radiance_cd_m2_[0]; }

  private:
    const Scene& scene_;
    const patches::Patches& patches_;
    ShadowRays rays_;
    std::vector<Material> rest_;                   ///< per material of the scene
    std::vector<patches::Float3> radiance_cd_m2_;  ///< per side and band
};

}  // namespace stilb::estimators
