// Isotropic point lights.
#pragma once

#include <numbers>

#include "lights/light_kind.h"
#include "math/sampling.h"

namespace stilb::lights {

class PointEmitter;

struct PointLight {
    Vec3 position;
    Rgb intensity_cd;

    static constexpr std::string_view kType = "point";
    static constexpr LightLocation kLocation = LightLocation::point;
    using Emitter = PointEmitter;
    Rgb flux_lm(const Surroundings& surroundings) const;
    std::vector<LightDetail> details(const Surroundings& surroundings) const;
    void scale(const Rgb& by) { intensity_cd *= by; }
    LightOrigin origin() const { return {position, std::nullopt, intensity_cd}; }
    bool shines_like(const PointLight&) const { return true; }
};

class PointEmitter {
  public:
    PointEmitter(const PointLight& light, const Surroundings& surroundings, const Lift& lift);

    Emission emit(math::SampleStream& stream) const;
    std::optional<IncidentLight> sample_incident(const SurfacePoint& at,
                                                 const std::array<double, 2>& u) const;
    double rough_illuminance_lx(const SurfacePoint& at) const;

    static constexpr std::string_view kNoun = "a point";
    const Vec3& lifted() const { return light_.position; }
    PointEmitter turned_into(const Frame&) const { return *this; }
    double luminous_intensity_cd(const Vec3&) const { return light_.intensity_cd.luminance(); }

  private:
    PointLight light_;
};

/// The light at a point from a source at `position` whose rays end at `lifted`. `intensity_cd` is called
/// with the unit direction towards the source.
template <typename Intensity>
std::optional<IncidentLight> incident_from_point(const Vec3& position, const Vec3& lifted, const Vec3& from,
                                                 const Intensity& intensity_cd) {
    const Vec3 towards = position - from;
    const double squared_distance = squared_length(towards);
    if (squared_distance == 0) return std::nullopt;
    const Vec3 direction = towards / std::sqrt(squared_distance);
    return IncidentLight{lifted, direction, intensity_cd(direction) * (1 / squared_distance),
                         std::numeric_limits<double>::infinity()};
}

/// The illuminance [lx] by such a source without shadows; its luminous intensity likewise.
template <typename Intensity>
double illuminance_by_point_lx(const Vec3& position, const SurfacePoint& at,
                               const Intensity& luminous_intensity_cd) {
    const Vec3 towards = position - at.position;
    const double squared_distance = squared_length(towards);
    const double height = dot(towards, at.normal);
    if (!(height > 0)) return 0;
    const double distance = std::sqrt(squared_distance);
    return luminous_intensity_cd(towards / distance) * height / (squared_distance * distance);
}

inline Rgb PointLight::flux_lm(const Surroundings&) const { return 4 * std::numbers::pi * intensity_cd; }

inline std::vector<LightDetail> PointLight::details(const Surroundings&) const {
    return {{"intensity_cd", intensity_cd.luminance()}};
}

inline PointEmitter::PointEmitter(const PointLight& light, const Surroundings&, const Lift&)
    : light_(light) {}

inline Emission PointEmitter::emit(math::SampleStream& stream) const {
    const auto [u1, u2] = stream.next_two();
    return {light_.position, math::sample_sphere(u1, u2).direction};
}

inline std::optional<IncidentLight> PointEmitter::sample_incident(const SurfacePoint& at,
                                                                  const std::array<double, 2>&) const {
    return incident_from_point(light_.position, light_.position, at.position,
                               [&](const Vec3&) { return light_.intensity_cd; });
}

inline double PointEmitter::rough_illuminance_lx(const SurfacePoint& at) const {
    return illuminance_by_point_lx(light_.position, at,
                                   [&](const Vec3&) { return light_.intensity_cd.luminance(); });
}

}  // namespace stilb::lights

namespace stilb {
using lights::PointLight;
}  // namespace stilb
