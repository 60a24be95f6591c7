// Incoming first shot [FirstShot 3, 4]: what arrives is stored, and reflected when it is asked for.
//
//     L*_j(w) = sum over samples i of e_ij f_j(w_i, w)
//
// w_i is the direction from the patch's middle to the sample: the BRDF is taken to be the same over a patch.
#pragma once

#include <span>
#include <vector>

#include "estimators/patch_light/first_shot/factors.h"
#include "estimators/patch_light/first_shot/surface.h"
#include "math/random.h"

namespace stilb::estimators {

/// Keeps references to scene and patches.
class IncomingFirstShot {
  public:
    IncomingFirstShot(const Scene& scene, const patches::Patches& patches, const FirstShotLights& lights,
                      FirstShotFactors factors);

    const FirstShotFactors& factors() const { return factors_; }
    Rgb illuminance_lx(std::uint32_t side) const;

    /// As FirstShot; the position does not matter.
    void add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                       std::span<const Vec3> outs, std::span<Rgb> sums) const;
    bool is_constant(std::uint32_t side) const;
    std::size_t bytes() const { return factors_.bytes(); }

  private:
    struct Source {
        Vec3 position;
        Rgb colour;
    };

    const Scene& scene_;
    const patches::Patches& patches_;
    std::vector<Source> sources_;  ///< per light sample
    FirstShotFactors factors_;
};

}  // namespace stilb::estimators
