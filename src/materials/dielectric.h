// What a smooth surface between two transparent media does to light, and glass, the solid that has it.
#pragma once

#include "materials/model.h"

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

/// The surface of a clear solid that stands in air: light is divided by Fresnel's equations for unpolarised
/// light and refracted by Snell's law. What a solid absorbs on the way is not handled.
struct Dielectric {
    double ior = 1.5;  ///< of the solid

    static constexpr std::string_view kType = "glass";
    static constexpr auto fields() {
        return std::tuple{Field{"ior", &Dielectric::ior, kIor, "refractive index of the solid"}};
    }

    SpecularBranches branches(LightSide side, const Vec3& in) const;
    Rgb reflectance_bound() const { return Rgb::grey(1); }
};

}  // namespace stilb::materials

namespace stilb {
using materials::Dielectric;
}  // namespace stilb
