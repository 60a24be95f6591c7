// Parameters of our materials for the surfaces that other formats describe.
#pragma once

#include "materials/material.h"
#include "materials/plastic.h"
#include "materials/thin_dielectric.h"

namespace stilb::io {

/// Plastic whose base returns the share `returned` of the light that has passed the coat, however often the
/// coat reflects it back: the surface reflects F + (1 - F) returned of uniform light, with F of the coat.
Plastic plastic_returning(const Rgb& returned, double ior, double roughness);

/// Fresnel's reflectance at normal incidence, and the index of refraction that has it.
double normal_reflectance(double ior);
double ior_of_normal_reflectance(double reflectance);

/// A thin sheet that reflects `reflectance` and transmits the rest times `transmittance` at normal incidence,
/// its two faces together.
ThinDielectric sheet(double reflectance, const Rgb& transmittance);

}  // namespace stilb::io
