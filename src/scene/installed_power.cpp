#include "scene/installed_power.h"

namespace stilb::scene {

InstalledPower installed_power(const Scene& scene) {
    InstalledPower all;
    for (const Light& light : scene.lights) {
        if (location_of(light) == LightLocation::infinity) continue;  // daylight takes none
        if (light.power_w) {
            all.power_w = all.power_w.value_or(0) + *light.power_w;
        } else {
            all.unknown.push_back(light.name);
        }
    }
    return all;
}

}  // namespace stilb::scene
