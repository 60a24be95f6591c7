
#include "lights/luminaire.h"

#include <cmath>
#include <numbers>

#include "lights/point.h"

namespace stilb::lights {

Rgb Luminaire::flux_lm(const Surroundings& surroundings) const {
    return surroundings.solid(solid).flux_lm() * factor;
}

std::vector<LightDetail> Luminaire::details(const Surroundings& surroundings) const {
    return {{"file", std::string(surroundings.file(solid))},
            {"peak_intensity_cd", surroundings.solid(solid).peak_cd() * factor.luminance()}};
}

LuminaireEmitter::LuminaireEmitter(const Luminaire& light, const Surroundings& surroundings, const Lift& lift)
    : light_(light),
      solid_(&surroundings.solid(light.solid)),
      lifted_(light.position + lift.offset_m(light.position, lift.largest_size_m()) * light.nadir) {}

Emission LuminaireEmitter::emit(math::SampleStream& stream) const {
    const auto [u1, u2] = stream.next_two();
    const Vec3 local = solid_->sample_direction(u1, u2);
    return {lifted_, normalized(local.x * light_.c0 + local.y * light_.c90 + local.z * light_.nadir)};
}

std::optional<IncidentLight> LuminaireEmitter::sample_incident(const SurfacePoint& at,
                                                               const std::array<double, 2>&) const {
    return incident_from_point(light_.position, lifted_, at.position, [&](const Vec3& direction) {
        return solid_->intensity_cd(light_.in_solid(-direction)) * light_.factor;
    });
}

double LuminaireEmitter::rough_illuminance_lx(const SurfacePoint& at) const {
    return illuminance_by_point_lx(light_.position, at, [&](const Vec3& direction) {
        const double bound_cd = solid_->intensity_bound_cd(light_.in_solid(-direction));
        return bound_cd * light_.factor.luminance();
    });
}

LuminaireEmitter LuminaireEmitter::turned_into(const Frame& frame) const {
    LuminaireEmitter turned = *this;
    turned.light_.c0 = frame.to_local(light_.c0);
    turned.light_.c90 = frame.to_local(light_.c90);
    turned.light_.nadir = frame.to_local(light_.nadir);
    return turned;
}

double LuminaireEmitter::luminous_intensity_cd(const Vec3& direction) const {
    return light_.factor.luminance() * solid_->intensity_cd(light_.in_solid(direction));
}

namespace {

/// The unit vector in the middle between the nadir of a hanging luminaire, -z, and the aim.
Vec3 halfway(const Vec3& aim) {
    const double horizontal_squared = aim.x * aim.x + aim.y * aim.y;
    // Aims close to +z: the difference of aim.z and 1 would be rounding only.
    const double z = aim.z > 0 ? -horizontal_squared / (1 + aim.z) : aim.z - 1;
    const Vec3 sum{aim.x, aim.y, z};
    const double size = length(sum);
    return size > 0 ? sum / size : Vec3{0, 1, 0};
}

}  // namespace

LuminaireFrame aim_luminaire(const Vec3& unit_aim, double spin_deg) {
    const double spin = spin_deg * std::numbers::pi / 180;
    const Vec3 hanging_c0{std::cos(spin), std::sin(spin), 0};
    const Vec3 hanging_c90{-std::sin(spin), std::cos(spin), 0};
    // The shortest turn is a half turn about the nadir and then one about the vector halfway to the aim; the
    // first changes the sign of horizontal vectors.
    const Vec3 axis = halfway(unit_aim);
    return {reflected(-hanging_c0, axis), reflected(-hanging_c90, axis), unit_aim};
}

}  // namespace stilb::lights
