#include "lights/area.h"

#include <numbers>

namespace stilb::lights {

Rgb AreaLight::flux_lm(const Surroundings& surroundings) const {
    return std::numbers::pi * area_m2(surroundings.shape(object)) * luminance_cd_m2;
}

std::vector<LightDetail> AreaLight::details(const Surroundings& surroundings) const {
    return {{"object", std::string(surroundings.name(object))},
            {"luminance_cd_m2", luminance_cd_m2.luminance()}};
}

AreaEmitter::AreaEmitter(const AreaLight& light, const Surroundings& surroundings, const Lift& lift)
    : luminance_cd_m2_(light.luminance_cd_m2),
      flux_lm_(light.flux_lm(surroundings).luminance()),
      surface_(surroundings.shape(light.object), lift) {}

Emission AreaEmitter::emit(math::SampleStream& stream) const {
    const EmitterPoint point = surface_.sample_by_area(stream.next_two());
    const std::array<double, 2> u = stream.next_two();
    const Vec3 direction =
        Frame::around(point.normal).to_world(math::sample_cosine_hemisphere(u[0], u[1]).direction);
    return {point.lifted, direction, Rgb::grey(point.weight)};
}

std::optional<IncidentLight> AreaEmitter::sample_incident(const SurfacePoint& at,
                                                          const std::array<double, 2>& u) const {
    const auto seen = surface_.sample_seen(at.position, u);
    if (!seen) return std::nullopt;
    return IncidentLight{seen->lifted, seen->direction, luminance_cd_m2_ * (1 / seen->pdf_per_sr),
                         seen->rough_pdf_per_sr};
}

double AreaEmitter::rough_illuminance_lx(const SurfacePoint& at) const {
    // Never zero: part of the emitter may be above the horizon wherever its middle is.
    return flux_lm_ /
           (squared_length(surface_.middle() - at.position) + surface_.radius_m() * surface_.radius_m());
}

}  // namespace stilb::lights
