#include "sensors/goniometer.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "lights/luminaire_frame.h"

namespace stilb::sensors {
namespace {

/// Steps from 0 that stay below `limit_deg`; one that meets it but for rounding does not.
std::int64_t steps_below(double limit_deg, double step_deg) {
    constexpr double rounding = 1e-9;
    return static_cast<std::int64_t>(std::ceil(limit_deg / step_deg - rounding)) - 1;
}

std::vector<PolarAngles> angles_of(const Goniometer& goniometer) {
    const double step = goniometer.step_deg;
    const std::int64_t thetas = steps_below(90, step), phis = steps_below(360, step);
    std::vector<PolarAngles> angles;
    angles.reserve(static_cast<std::size_t>(direction_count(goniometer)));
    for (std::int64_t t = goniometer.plane_deg ? -thetas : 0; t <= thetas; ++t) {
        const double theta = static_cast<double>(t) * step;
        if (goniometer.plane_deg) {
            angles.push_back({theta, *goniometer.plane_deg});
            continue;
        }
        for (std::int64_t p = 0; p <= (t > 0 ? phis : 0); ++p)
            angles.push_back({theta, static_cast<double>(p) * step});
    }
    return angles;
}

/// The frame that directions are given in, w along the normal.
Frame frame_of(const Vec3& normal) {
    // The turn of +z to the normal is that of -z to its opposite.
    const lights::LuminaireFrame turned = lights::aim_luminaire(-normal, 0);
    return {turned.c0, turned.c90, normal};
}

Vec3 local_direction(const PolarAngles& angles) {
    constexpr double per_degree = std::numbers::pi / 180;
    const double theta = angles.theta_deg * per_degree, phi = angles.phi_deg * per_degree;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace

std::int64_t direction_count(const Goniometer& goniometer) {
    const std::int64_t thetas = steps_below(90, goniometer.step_deg);
    if (goniometer.plane_deg) return 2 * thetas + 1;
    return 1 + thetas * (steps_below(360, goniometer.step_deg) + 1);
}

Sensor make_goniometer_sensor(std::string name, const Goniometer& goniometer) {
    Sensor sensor{std::move(name), SensorType::goniometer, {}};
    sensor.angles = angles_of(goniometer);
    const Frame frame = frame_of(goniometer.normal);
    for (const PolarAngles& angles : sensor.angles) {
        const Vec3 direction = normalized(frame.to_world(local_direction(angles)));
        sensor.measurands.push_back(EmergentRay{goniometer.point, goniometer.normal, direction});
    }
    return sensor;
}

}  // namespace stilb::sensors
