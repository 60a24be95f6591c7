// The exchange of light between patches: form factors of single patches, by item buffers around their
// middles.
//
//     F_ij = (1/pi) sum over pixels p in P_j of cos(theta_p) dW_p                     [Cohen, Greenberg 1985]
//
// P_j are the pixels in which side j is seen from the middle of side i. The middle represents the whole
// patch: inaccurate where j is close to i relative to its size, above all in corners. Nothing is stored.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "estimators/patch_light/first_shot/factors.h"
#include "patches/visibility/item_buffer.h"

namespace stilb::estimators {

struct FormFactor {
    std::uint32_t side = 0;  ///< that receives
    float share = 0;         ///< of the flux that is sent diffusely
};

/// Keeps a reference to the caster.
class PatchShots {
  public:
    /// Throws InputError where the resolution is invalid (ItemBufferLayout) and where OpenGL is missing.
    PatchShots(const patches::PatchCaster& caster, const ShootingOptions& options);
    ~PatchShots();

    /// The form factors of each of `sides` to all sides that it sees, which add up to 1 in a closed scene.
    /// Rays use all threads. Buffers are turned about the normal by an angle of the side's own: parallel to
    /// the walls, all patches of a wall would have the same errors.
    std::vector<std::vector<FormFactor>> from(std::span<const std::uint32_t> sides);

    std::uint64_t rays_per_shot() const { return layout_.pixel_count(); }

  private:
    struct Shooters;

    const patches::PatchCaster& caster_;
    patches::ItemBufferLayout layout_;
    std::vector<float> weights_;  ///< per pixel: its share of the flux
    std::unique_ptr<Shooters> shooters_;
};

}  // namespace stilb::estimators
