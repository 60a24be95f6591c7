// Distant sources of Radiance, which together surround the scene.
#pragma once

#include <optional>
#include <vector>

#include "io/import/radiance/sky_pattern.h"
#include "lights/environment.h"

namespace stilb::io::radiance {

struct DistantSource {
    Vec3 direction;        ///< towards it, not necessarily a unit vector
    double angle_deg;      ///< its diameter
    Rgb radiance_w_sr_m2;  ///< without the patterns
    /// Where sources overlap, the first is seen, but only the last of those that give way.
    bool gives_way = false;
    std::vector<SkyPattern> patterns = {};

    /// The factor of its patterns on the radiance from a direction.
    double factor(const Vec3& towards) const {
        double product = 1;
        for (const SkyPattern& pattern : patterns) product *= pattern.factor(towards);
        return product;
    }
};

/// Nothing where there is no light. A source all around is exact; others are drawn into a panorama, such that
/// each casts the light of its solid angle.
std::optional<EnvironmentLight> environment_of(const std::vector<DistantSource>& sources);

}  // namespace stilb::io::radiance
