#include "sensors/goniometer.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "lights/luminaire.h"

namespace stilb::sensors {
namespace {

/// Steps from 0 below `limit_deg`; a step that meets it up to rounding is excluded.
std::int64_t steps_below(double limit_deg, double step_deg) {
    constexpr double rounding = 1e-9;
    return static_cast<std::int64_t>(std::ceil(limit_deg / step_deg - rounding)) - 1;
}

/// The frame of the directions, w along the normal.
Frame frame_of(const Vec3& normal) {
    // The rotation of +z to the normal is that of -z to its opposite.
    const lights::LuminaireFrame turned = lights::aim_luminaire(-normal, 0);
    return {turned.c0, turned.c90, normal};
}

Vec3 local_direction(const PolarAngles& angles) {
    constexpr double per_degree = std::numbers::pi / 180;
    const double theta = angles.theta_deg * per_degree, phi = angles.phi_deg * per_degree;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace

std::optional<Fault> Goniometer::settle(const GivenKeys&) const {
    const std::int64_t count = direction_count();
    if (count <= kMostReadings) return std::nullopt;
    return Fault{"step", fmt::format("asks for {} directions. Allowed: {} readings in all sensors together.",
                                     count, kMostReadings)};
}

std::int64_t Goniometer::direction_count() const {
    const std::int64_t thetas = steps_below(90, step_deg);
    if (plane_deg) return 2 * thetas + 1;
    return 1 + thetas * (steps_below(360, step_deg) + 1);
}

PolarAngles Goniometer::angles(std::size_t j) const {
    const auto i = static_cast<std::int64_t>(j);
    if (plane_deg) return {static_cast<double>(i - steps_below(90, step_deg)) * step_deg, *plane_deg};
    if (i == 0) return {0, 0};
    const std::int64_t azimuths = steps_below(360, step_deg) + 1;
    const std::int64_t rings = (i - 1) / azimuths;
    return {static_cast<double>(1 + rings) * step_deg, static_cast<double>((i - 1) % azimuths) * step_deg};
}

Measurand Goniometer::measurand(std::size_t j) const {
    return EmergentRay{point, normal, normalized(frame_of(normal).to_world(local_direction(angles(j))))};
}

Location Goniometer::location(std::size_t j) const {
    Location location = location_of(measurand(j));
    const auto [theta_deg, phi_deg] = angles(j);
    location.angles = {{"theta", theta_deg}, {"phi", phi_deg}};
    return location;
}

}  // namespace stilb::sensors
