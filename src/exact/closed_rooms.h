// The furnace: a closed enclosure whose walls all emit and reflect alike.
#pragma once

#include <array>

#include "base/vec.h"

namespace stilb::exact {

/// The luminance of every wall point in every direction, if all walls emit `emitted_cd_m2` in all
/// directions and have a BRDF of albedo `reflectance` (0 to less than 1, the same for all directions of
/// incidence), for any shape of the enclosure. Throws std::domain_error on arguments out of range.
double furnace_luminance_cd_m2(double emitted_cd_m2, double reflectance);

/// The illuminance in that enclosure, at any point and for any normal.
double furnace_illuminance_lx(double emitted_cd_m2, double reflectance);

// The photometric (integrating) sphere: the inside of a diffuse sphere, lit from within.

/// A diffuse wall seen from inside, with the centre at the origin.
struct PhotometricSphere {
    double radius_m = 1;     ///< positive
    double reflectance = 0;  ///< 0 to less than 1
};

/// The illuminance after one or more reflections: the same at every wall point, wherever the light is and
/// however it is distributed. Throws std::domain_error on arguments out of range.
double indirect_illuminance_lx(const PhotometricSphere& sphere, double flux_lm);

/// Direct and indirect illuminance of the wall in direction `to_wall` from the centre, by an isotropic point
/// source of flux `flux_lm` at `source`. Throws std::domain_error where the source is not inside the sphere.
double illuminance_lx(const PhotometricSphere& sphere, double flux_lm, const Vec3& source,
                      const Vec3& to_wall);

// Radiosity between two surfaces, and the form factors of the pairs for which they are known exactly.

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

/// The mean illuminance of each surface with all reflections between the two; the surroundings are black.
/// Exact where a surface is uniformly lit (concentric spheres) and, for the illuminance that comes
/// straight from uniformly emitting surfaces, without reflection; otherwise (disks) it is the radiosity
/// approximation, in which each surface reflects as if it were lit uniformly. Throws std::domain_error on
/// arguments out of range or where no light is ever absorbed.
std::array<double, 2> two_surface_illuminance_lx(const std::array<DiffuseSurface, 2>& surfaces,
                                                 const FormFactors& factors);

// The light that a thin sheet of glass lets through.

/// A thin plane sheet with parallel faces in air.
struct PaneOptics {
    double ior = 1.5;                   ///< of the sheet, above 1
    double internal_transmittance = 1;  ///< of one passage along the normal, without the faces; 0 to 1
};

/// The transmittance for unpolarised light at `angle_rad` to the normal, with all reflections between the
/// faces: by Fresnel's formulas in sines and tangents [Born, Wolf 1999, 1.5.2 (21a)] and the series of the
/// passages. Relative error below 1e-12. Throws std::domain_error on arguments out of range and on angles of
/// 90 degrees or more.
double pane_transmittance(const PaneOptics& pane, double angle_rad);

}  // namespace stilb::exact
