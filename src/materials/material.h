// Materials: how a surface reflects. Every material is two-sided: both sides reflect alike.
//
// One more model is two new files, with what the concept Model of model.h asks for, and its name in the list
// here. Directions are as model.h has them. Formulas and limits: docs/materials.md.
#pragma once

#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/model.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/thin_dielectric.h"
#include "materials/ward.h"

namespace stilb::materials {

/// In the order of lists for users.
using Material =
    std::variant<Diffuse, Phong, RoughConductor, Ward, Plastic, Mirror, Dielectric, ThinDielectric, Black>;

/// Calls `visit.template operator()<M>()` for every model M, in order.
template <typename Visit>
void for_each_model(const Visit& visit) {
    [&]<typename... Models>(std::type_identity<std::variant<Models...>>) {
        (visit.template operator()<Models>(), ...);
    }(std::type_identity<Material>{});
}

/// Names of the models in scene files.
std::vector<std::string_view> type_names();

/// BRDF [1/sr]; 0 for directions below the surface and for specular materials. Reciprocal. For one model too,
/// so that a loop over many directions can pick the model outside.
template <Model M>
Rgb evaluate_brdf_per_sr([[maybe_unused]] const M& model, [[maybe_unused]] const Vec3& in,
                         [[maybe_unused]] const Vec3& out) {
    if constexpr (Scattering<M>) {
        return in.z > 0 && out.z > 0 ? model.brdf_per_sr(in, out) : Rgb{};
    } else {
        return {};
    }
}
inline Rgb evaluate_brdf_per_sr(const Material& material, const Vec3& in, const Vec3& out) {
    return std::visit([&](const auto& model) { return evaluate_brdf_per_sr(model, in, out); }, material);
}

/// Direction drawn from the material's own density, by two numbers in [0, 1); nothing where light is
/// absorbed and for specular materials, which specular_branches() has the directions of.
std::optional<ScatterSample> sample_brdf(const Material& material, const Vec3& in, double u1, double u2);
/// The density that sample_brdf() draws from. Its integral falls short of 1 by the probability of absorption.
double pdf_per_sr(const Material& material, const Vec3& in, const Vec3& out);
/// evaluate_brdf_per_sr(material, in, out) and pdf_per_sr(material, out, in), to the last bit, at the price
/// of one.
ScatterValue evaluate_and_pdf(const Material& material, const Vec3& in, const Vec3& out);

/// Mirror, glass, pane: no connection to such a surface is possible.
bool is_specular(const Material& material);
/// Where light that comes to the surface from `in` goes on from a specular surface; nowhere from others.
SpecularBranches specular_branches(const Material& material, LightSide side, const Vec3& in);
/// Whether light goes straight on through the surface, which shadow rays then do as well: panes.
bool passes_straight(const Material& material);
/// Its share of the flux, at an angle of this cosine to the normal; 0 where nothing does.
Rgb straight_transmittance(const Material& material, double cosine);

/// pi f / albedo, averaged over the reflected light, roughly: 1 on diffuse surfaces, large where a lobe
/// dominates; 0 for specular materials and where nothing is reflected.
double mean_concentration(const Material& material);
/// Largest share of arriving light that is reflected or goes on, per band (a bound over directions); but for
/// plastic, whose share rises to 1 along the surface, that of light from everywhere.
Rgb reflectance_bound(const Material& material);
/// What reports state: the bound, but of specular materials what they reflect at normal incidence.
Rgb stated_reflectance(const Material& material);

/// Throws an InputError with the words of the scene reader where a parameter is out of its range, or several
/// contradict each other. `path`: such as materials.wall.
void validate(const Material& material, std::string_view path);
/// The model of these parameters, which are checked first: a table made of wrong ones would be nonsense.
template <Model M>
M make(const ParametersOf<M>& parameters, std::string_view path) {
    validate_fields(parameters, path);
    return M(parameters);
}

}  // namespace stilb::materials

namespace stilb {
using materials::Material;
}  // namespace stilb
