// What a smooth surface between two transparent media does to light.
#pragma once

namespace stilb::materials {

/// Shares of the flux that are reflected, for light polarised across (s) and along (p) the plane of
/// incidence.
struct FresnelReflectance {
    double s = 0, p = 0;

    double unpolarised() const { return (s + p) / 2; }
};

/// Cosine of the refracted ray's angle to the normal, of light that arrives at the angle of `cosine` >= 0; 0
/// where all is reflected. `ior` is that of the far side over that of the near one.
double refracted_cosine(double cosine, double ior);

/// Fresnel's equations [Born, Wolf 1999, Principles of optics, 1.5.2 (21)]. 1 beyond the angle of total
/// reflection.
FresnelReflectance fresnel_reflectance(double cosine, double ior);

}  // namespace stilb::materials
