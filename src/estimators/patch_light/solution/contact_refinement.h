// Patches for the vertices that light is gathered at: finer where other surfaces are near, because light
// changes quickly there.
#pragma once

#include <cstddef>
#include <vector>

#include "base/monitor.h"
#include "estimators/patch_light/patch_transport.h"
#include "patches/patches.h"

namespace stilb::estimators {

/// The light on the sides of the walks' patches, as the walks have found it so far.
struct SideLight {
    std::vector<bool> is_lit;  ///< whether any light reaches or leaves the side
    std::vector<double> lx;    ///< illuminances, direct light included
};

/// Finer patches than those of a walk: at most `most`, divided where other surfaces are near, and less where
/// it is dark.
patches::FinePatches patches_near_contacts(const PatchTransport& coarse, const SideLight& light,
                                           std::size_t most, const Monitor& monitor);

}  // namespace stilb::estimators
