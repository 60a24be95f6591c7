// The electric power of the lamps of a scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace stilb::scene {

/// Of all lamps at full output: dimming and maintenance factors change nothing.
struct InstalledPower {
    std::optional<double> power_w;     ///< of the lamps whose power is known; nothing where there are none
    std::vector<std::string> unknown;  ///< the names of the other lamps

    bool has_lamps() const { return power_w || !unknown.empty(); }
};
InstalledPower installed_power(const Scene& scene);

}  // namespace stilb::scene
