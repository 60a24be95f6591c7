// Radiosity between two surfaces, and the form factors of the pairs for which they are known exactly.
#pragma once

#include <array>

namespace stilb::exact {

/// from_to[i][j]: the share of the flux that surface i+1 emits diffusely and uniformly that reaches surface
/// j+1.
struct FormFactors {
    std::array<std::array<double, 2>, 2> from_to;
};

/// Two disks on one axis that face each other. Throws std::domain_error on lengths that are not positive.
FormFactors coaxial_disk_form_factors(double radius_1_m, double radius_2_m, double distance_m);

/// Surface 1 is the outside of the inner sphere, surface 2 the inside of the outer one; 0 < inner < outer.
FormFactors concentric_sphere_form_factors(double inner_radius_m, double outer_radius_m);

struct DiffuseSurface {
    double emitted_lm_m2 = 0;  ///< its own luminous exitance, not negative
    double reflectance = 0;    ///< 0 to 1
};

/// The mean illuminance of each surface with all reflections between the two; the rest of the world is black.
/// Exact where every point of a surface is lit alike (concentric spheres) and, for the illuminance that comes
/// straight from uniformly emitting surfaces, without reflection; otherwise (disks) it is the radiosity
/// approximation, in which each surface reflects as if it were lit uniformly. Throws std::domain_error on
/// arguments out of range or where no light is ever absorbed.
std::array<double, 2> two_surface_illuminance_lx(const std::array<DiffuseSurface, 2>& surfaces,
                                                 const FormFactors& factors);

}  // namespace stilb::exact
