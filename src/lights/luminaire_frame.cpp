#include "lights/luminaire_frame.h"

#include <cmath>
#include <numbers>

namespace stilb::lights {
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
