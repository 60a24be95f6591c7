// Materials: how a surface reflects. Every material is two-sided: both sides reflect alike.
//
// Directions are unit vectors in the local frame of the surface (Frame::of_surface), z along the normal on
// the side that light arrives on, both pointing away from the surface. Formulas and limits:
// docs/materials.md.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "base/rgb.h"
#include "base/vec.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/scatter_sample.h"
#include "materials/specular.h"
#include "materials/ward.h"

namespace stilb::materials {

/// f = reflectance / pi.
struct Diffuse {
    Rgb reflectance;
};

/// Energy-normalised modified Phong: f = diffuse/pi + specular (n+2)/(2 pi) cos+^n(alpha), where alpha is the
/// angle to the mirrored direction and n the exponent; diffuse + specular <= 1 in every band.
struct Phong {
    Rgb diffuse;
    Rgb specular;
    double exponent = 1;
};

/// Reflects nothing.
struct Black {};

using Material =
    std::variant<Diffuse, Phong, RoughConductor, Ward, Plastic, Mirror, Dielectric, ThinDielectric, Black>;

/// cos+^n(alpha): the unnormalised lobe.
inline double phong_lobe(const Phong& material, const Vec3& in, const Vec3& out) {
    const double cos_alpha = in.z * out.z - in.x * out.x - in.y * out.y;
    return cos_alpha > 0 ? std::pow(cos_alpha, material.exponent) : 0;
}

/// BRDF [1/sr]; 0 for directions below the surface and for delta functions. Reciprocal. One overload per
/// material too, so that a loop over many directions can pick the material outside.
inline Rgb evaluate_brdf_per_sr(const Diffuse& material, const Vec3& in, const Vec3& out) {
    return in.z > 0 && out.z > 0 ? material.reflectance * std::numbers::inv_pi : Rgb{};
}
inline Rgb evaluate_brdf_per_sr(const Phong& material, const Vec3& in, const Vec3& out) {
    if (in.z <= 0 || out.z <= 0) return {};
    const double lobe_per_sr =
        (material.exponent + 2) / (2 * std::numbers::pi) * phong_lobe(material, in, out);
    return material.diffuse * std::numbers::inv_pi + material.specular * lobe_per_sr;
}
/// Rough, Ward, Plastic.
template <typename Own>
Rgb evaluate_brdf_per_sr(const Own& material, const Vec3& in, const Vec3& out) {
    return in.z > 0 && out.z > 0 ? material.brdf_per_sr(in, out) : Rgb{};
}
inline Rgb evaluate_brdf_per_sr(const Mirror&, const Vec3&, const Vec3&) { return {}; }
inline Rgb evaluate_brdf_per_sr(const Dielectric&, const Vec3&, const Vec3&) { return {}; }
inline Rgb evaluate_brdf_per_sr(const ThinDielectric&, const Vec3&, const Vec3&) { return {}; }
inline Rgb evaluate_brdf_per_sr(const Black&, const Vec3&, const Vec3&) { return {}; }
inline Rgb evaluate_brdf_per_sr(const Material& material, const Vec3& in, const Vec3& out) {
    return std::visit([&](const auto& m) { return evaluate_brdf_per_sr(m, in, out); }, material);
}

/// Direction drawn from the material's own density, by two numbers in [0, 1); nothing where light is
/// absorbed and for delta functions, which specular_branches() has the directions of.
std::optional<ScatterSample> sample_brdf(const Material& material, const Vec3& in, double u1, double u2);
/// The density that sample_brdf() draws from. Its integral falls short of 1 by the probability of absorption.
double pdf_per_sr(const Material& material, const Vec3& in, const Vec3& out);
/// Mirror, glass, pane: no connection to such a surface is possible.
bool is_specular(const Material& material);
/// Where light goes on from a specular surface; nowhere from others.
SpecularBranches specular_branches(const Material& material, LightSide side, const Vec3& in);
/// pi f / albedo, averaged over the reflected light, roughly: 1 on diffuse surfaces, large where a lobe
/// dominates; 0 for delta functions and where nothing is reflected.
double mean_concentration(const Material& material);
/// Largest share of arriving light that is reflected, per band (a bound over directions); but for plastic,
/// whose share rises to 1 along the surface, that of light from everywhere.
Rgb reflectance_bound(const Material& material);

}  // namespace stilb::materials

namespace stilb {
using materials::Black;
using materials::Diffuse;
using materials::Material;
using materials::Phong;
}  // namespace stilb
