// What became of surfaces and lights where patches stand for them, for the results.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "estimators/patch_light/first_shot/first_shot.h"

namespace stilb::estimators {

/// All but the time is the same whenever the same is computed.
struct PatchReport {
    std::size_t count = 0;  ///< of patches
    double size_m = 0;      ///< no edge is longer
    FirstShotVariant first_shot = FirstShotVariant::none;
    std::optional<int> resolution;       ///< of first shot's item buffers, where there are any
    std::size_t missed = 0;              ///< as FirstShot::missed()
    double bytes_per_patch = 0;          ///< stored by first shot
    double set_up_s = 0;                 ///< of first shot
    std::vector<FirstShotLight> lights;  ///< as Scene::lights
};

}  // namespace stilb::estimators
