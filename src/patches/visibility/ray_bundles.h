// Bundles by rays.
#pragma once

#include "patches/visibility/bundle.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::patches {

/// Casts may run in parallel, each on its thread. Keeps a reference to the caster.
class RayBundles : public Bundles {
  public:
    explicit RayBundles(const PatchCaster& caster) : caster_(caster), bounds_(bounds_of(caster.patches())) {}

    void cast(const Bundle& bundle, const LineVisitor& visit) const override;

  private:
    const PatchCaster& caster_;
    Bounds bounds_;
};

}  // namespace stilb::patches
