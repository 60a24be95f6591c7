// Materials: how a surface reflects. Every material is two-sided: both sides reflect alike.
//
// Directions are unit vectors in the local frame of the surface, z along the normal on the side that light
// arrives on, both pointing away from the surface. Formulas and limits: docs/materials.md.
#pragma once

#include <optional>
#include <variant>

#include "base/spectrum.h"
#include "base/vec.h"

namespace stilb {

/// f = reflectance / pi.
struct Diffuse {
    Spectrum reflectance;
};

/// Energy-normalised modified Phong: f = diffuse/pi + specular (n+2)/(2 pi) cos+^n(alpha), where alpha is the
/// angle to the mirrored direction and n the exponent; diffuse + specular <= 1 in every band.
struct Phong {
    Spectrum diffuse;
    Spectrum specular;
    double exponent = 1;
};

/// Ideal mirror: a delta function, so its BRDF cannot be evaluated, only sampled.
struct Mirror {
    Spectrum reflectance;
};

/// Reflects nothing.
struct Black {};

using Material = std::variant<Diffuse, Phong, Mirror, Black>;

/// A scattered direction and what the light is multiplied by: weight = f cos(theta_out) / pdf.
struct ScatterSample {
    Vec3 direction;
    Spectrum weight;
    double pdf_per_sr = 0;  ///< 0 where `specular`: a delta function has no density
    bool specular = false;
};

/// BRDF [1/sr]; 0 for directions below the surface and for delta functions. Reciprocal.
Spectrum evaluate_brdf_per_sr(const Material& material, const Vec3& in, const Vec3& out);
/// Direction drawn from the material's own density, by two numbers in [0, 1); nothing where light is
/// absorbed.
std::optional<ScatterSample> sample_brdf(const Material& material, const Vec3& in, double u1, double u2);
/// The density that sample_brdf() draws from.
double pdf_per_sr(const Material& material, const Vec3& in, const Vec3& out);
/// True where the whole reflection is a delta function: no connection to such a surface is possible.
bool is_specular(const Material& material);
/// Largest share of arriving light that is reflected, per band (a bound over directions).
Spectrum reflectance_bound(const Material& material);

}  // namespace stilb
