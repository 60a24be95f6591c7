// A view whose Daylight Glare Probability is known: its sums are closed forms.
#pragma once

#include <cmath>

#include "support/scene_builder.h"
#include "transport/glare/glare.h"

namespace stilb {

inline const MeasuringPoint kEye{{0, 0, 1.2}, {0, 1, 0}};

inline double dgp(double illuminance_lx, double glare) {
    return 5.87e-5 * illuminance_lx + 0.0918 * std::log10(1 + glare / std::pow(illuminance_lx, 1.87)) + 0.16;
}

/// A lamp that faces the eye in an environment; the environment is no source of glare.
inline Scene lamp_in_an_environment() {
    Scene scene;
    add_area_light(scene, Disk{{0.5, 3, 2.2}, normalized(Vec3{-0.5, -3, -1}), 0.2}, Rgb::grey(30000));
    add_environment(scene, Rgb::grey(200));
    return scene;
}

inline double lamp_dgp() {
    const Vec3 towards{0.5, 3, 1};
    const double distance = length(towards), hypotenuse = std::hypot(distance, 0.2);
    const double solid_angle_sr = 2 * kPi * (1 - distance / hypotenuse);
    const double p = transport::position_index(normalized(towards), kEye.normal);
    const double projected_sr = kPi * 0.04 / (hypotenuse * hypotenuse) * towards.y / distance;
    const double illuminance_lx = 30000 * projected_sr + 200 * (kPi - projected_sr);
    return dgp(illuminance_lx, 30000.0 * 30000 * solid_angle_sr / (p * p));
}

}  // namespace stilb
