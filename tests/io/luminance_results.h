// Results of luminance sensors, made by hand.
#pragma once

#include "run/result.h"

namespace stilb::io {

inline Reading reading(double value) {
    return {{value, 1, value - 2, value + 2}, {{value + 10, value, value - 10}}};
}

/// A sensor "view" with two lines of sight of 100 and 200 cd/m2: the first meets (2, 4, 1), the second leaves
/// the scene. A goniometer "solid" with directions at -60, 0 and 60 degrees
/// in the plane of azimuth 90, of 29, 30 and 31 cd/m2.
inline RunResult luminance_results() {
    const Sensor view{"view",
                      Luminance{{LineOfSight{{2, 0, 1}, {0, 1, 0}}, LineOfSight{{2, 0, 1}, {0, 0, 1}}}}};
    const Sensor solid{"solid", Goniometer{{2, 2, 0}, {0, 0, 1}, 90.0, 60}};
    const statistics::Estimate low{100, 1, 98, 102}, high{200, 1, 198, 202}, mean{150, 1, 148, 152};
    RunResult result;
    result.method = "auto";
    result.technique = "light-paths";
    result.sensors = {
        {view, {reading(100), reading(200)}, {Vec3{2, 4, 1}, std::nullopt}, {mean, low, high, {}}, 0.02},
        {solid, {reading(29), reading(30), reading(31)}, {}, {mean, low, high, {}}, 0.07}};
    return result;
}

/// Of 1000 patches and incoming first shot for a bulb, but not for a large panel.
inline estimators::PatchReport patch_report() {
    return {1000,
            0.25,
            estimators::FirstShotVariant::incoming,
            256,
            3,
            71.5,
            0.125,
            {{"bulb", true, "a point", 1, {}}, {"panel", false, "large", 0, {}}}};
}

}  // namespace stilb::io
