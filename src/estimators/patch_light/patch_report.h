// What became of surfaces and lights where patches stand for them, for the results: plain values.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/rgb.h"
#include "estimators/patch_light/patch_options.h"

namespace stilb::estimators {

/// What first shot made of a light.
struct FirstShotLight {
    std::string name;
    bool is_replaced = false;
    std::string why;          ///< in words: "a point", "large: it would take more than 32 vertices ..."
    std::size_t samples = 0;  ///< 0 where it is not replaced
    Rgb colour{};             ///< of its light: luminance 1; nothing where it is dark
};

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
