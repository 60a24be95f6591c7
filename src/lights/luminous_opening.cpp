#include "lights/luminous_opening.h"

#include <numbers>

namespace stilb::lights {

std::vector<LightDetail> LuminousOpening::details(const Surroundings& surroundings) const {
    std::vector<LightDetail> details = luminaire.details(surroundings);
    details.push_back({"opening_m2", area_m2(surroundings.shape(object))});
    return details;
}

Rgb LuminousOpening::mean_luminance_cd_m2(const Surroundings& surroundings) const {
    return flux_lm(surroundings) * (1 / (std::numbers::pi * area_m2(surroundings.shape(object))));
}

OpeningEmitter::OpeningEmitter(const LuminousOpening& light, const Surroundings& surroundings,
                               const Lift& lift)
    : luminaire_(light.luminaire),
      solid_(&surroundings.solid(light.luminaire.solid)),
      flux_lm_(light.flux_lm(surroundings).luminance()),
      surface_(surroundings.shape(light.object), lift) {}

Emission OpeningEmitter::emit(math::SampleStream& stream) const {
    const auto [u1, u2] = stream.next_two();
    const Vec3 local = solid_->sample_direction(u1, u2);
    const Vec3 direction =
        normalized(local.x * luminaire_.c0 + local.y * luminaire_.c90 + local.z * luminaire_.nadir);
    const std::array<double, 2> u = stream.next_two();
    // Of a one-sided opening, which sends nothing to the other side.
    if (!(surface_.projected_area_m2(direction) > 0)) return {surface_.middle(), direction, {}};
    const EmitterPoint point = surface_.sample_projected(direction, u);
    return {point.lifted, direction, Rgb::grey(point.weight)};
}

std::optional<IncidentLight> OpeningEmitter::sample_incident(const SurfacePoint& at,
                                                             const std::array<double, 2>& u) const {
    const auto seen = surface_.sample_seen(at.position, u);
    if (!seen) return std::nullopt;
    return IncidentLight{seen->lifted, seen->direction,
                         luminance_cd_m2(-seen->direction) * (1 / seen->pdf_per_sr), seen->rough_pdf_per_sr};
}

double OpeningEmitter::rough_illuminance_lx(const SurfacePoint& at) const {
    const Vec3 towards = at.position - surface_.middle();
    const double squared_m2 = squared_length(towards), radius_m2 = surface_.radius_m() * surface_.radius_m();
    const double far_cd =
        squared_m2 > 0 ? luminaire_.factor.luminance() *
                             solid_->intensity_bound_cd(luminaire_.in_solid(towards / std::sqrt(squared_m2)))
                       : 0;
    // Never zero: nearby, parts of the opening send light from other directions than its middle.
    const double near_share = radius_m2 / (squared_m2 + radius_m2);
    return (far_cd + near_share * flux_lm_) / (squared_m2 + radius_m2);
}

Rgb OpeningEmitter::luminance_cd_m2(const Vec3& leaving) const {
    const double projected_m2 = surface_.projected_area_m2(leaving);
    if (!(projected_m2 > 0)) return {};
    return (solid_->intensity_cd(luminaire_.in_solid(leaving)) / projected_m2) * luminaire_.factor;
}

}  // namespace stilb::lights
