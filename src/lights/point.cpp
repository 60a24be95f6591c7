#include "lights/point.h"

#include <numbers>

#include "math/sampling.h"

namespace stilb::lights {

Rgb PointLight::flux_lm(const Surroundings&) const { return 4 * std::numbers::pi * intensity_cd; }

std::vector<LightDetail> PointLight::details(const Surroundings&) const {
    return {{"intensity_cd", intensity_cd.luminance()}};
}

PointEmitter::PointEmitter(const PointLight& light, const Surroundings&, const Lift&) : light_(light) {}

Emission PointEmitter::emit(math::SampleStream& stream) const {
    const auto [u1, u2] = stream.next_two();
    return {light_.position, math::sample_sphere(u1, u2).direction};
}

std::optional<IncidentLight> PointEmitter::sample_incident(const ReceivingPoint& at,
                                                           const std::array<double, 2>&) const {
    return incident_from_point(light_.position, light_.position, at.position,
                               [&](const Vec3&) { return light_.intensity_cd; });
}

double PointEmitter::rough_illuminance_lx(const Vec3& from, const Vec3& normal) const {
    return illuminance_by_point_lx(light_.position, from, normal,
                                   [&](const Vec3&) { return light_.intensity_cd.luminance(); });
}

}  // namespace stilb::lights
