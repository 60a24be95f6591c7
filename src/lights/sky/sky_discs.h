// Suns, skies and other round parts of the surroundings, which together light a scene.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lights/environment.h"

namespace stilb::lights {

struct SkyDisc {
    Vec3 towards;      ///< its middle, not necessarily a unit vector
    double angle_deg;  ///< its diameter
    Rgb luminance_cd_m2;
    /// Where discs overlap, the first is seen, but only the last of those that give way.
    bool gives_way = false;
    /// The factor on the luminance from a unit vector, at least 0; 1 where there is none.
    std::function<double(const Vec3& towards)> factor = {};
};

/// Nothing where there is no light. A disc all around without a factor is exact; others are drawn into a
/// panorama, such that each casts the light of its solid angle.
std::optional<EnvironmentLight> environment_of(const std::vector<SkyDisc>& discs);

}  // namespace stilb::lights
