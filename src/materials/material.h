// Materials: the reflection models of surfaces. Every material is two-sided: both sides reflect equally.
//
// A new model is two new files with the members of the concept Model of model.h, and its name in the list
// here. Directions are those of model.h. Formulas and limits: docs/materials.md.
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

/// BRDF [1/sr]; 0 for directions below the surface and for specular materials. Reciprocal. Available for one
/// model too, so that a loop over many directions can select the model outside.
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

/// Samples a direction from the material's own density, by two numbers in [0, 1); nothing where light is
/// absorbed and for specular materials, whose directions specular_branches() gives.
std::optional<ScatterSample> sample_brdf(const Material& material, const Vec3& in, double u1, double u2);
/// The density of sample_brdf(). Its integral falls short of 1 by the probability of absorption.
double pdf_per_sr(const Material& material, const Vec3& in, const Vec3& out);
/// evaluate_brdf_per_sr(material, in, out) and pdf_per_sr(material, out, in), bit by bit, for the cost
/// of one.
ScatterValue evaluate_and_pdf(const Material& material, const Vec3& in, const Vec3& out);

/// True for mirror, glass and pane: no connection to such a surface is possible.
bool is_specular(const Material& material);
/// The branches in which light from `in` leaves a specular surface; none for other materials.
SpecularBranches specular_branches(const Material& material, LightSide side, const Vec3& in);
/// Whether light gets through the surface.
bool transmits(const Material& material);
/// Whether light passes straight through the surface, as shadow rays then do: panes.
bool passes_straight(const Material& material);
/// Its share of the flux, at an angle of this cosine to the normal; 0 for other materials.
Rgb straight_transmittance(const Material& material, double cosine);

/// The mean of pi f / albedo over the reflected light, roughly: 1 on diffuse surfaces, large where a lobe
/// dominates; 0 for specular materials and where nothing is reflected.
double mean_concentration(const Material& material);
/// Largest share of arriving light that is reflected or transmitted, per band (a bound over directions); for
/// plastic, whose share rises to 1 at grazing angles, that of uniform illumination.
Rgb reflectance_bound(const Material& material);
/// The reflectance in reports: the bound, except for specular materials, whose value is that at normal
/// incidence.
Rgb stated_reflectance(const Material& material);

/// Throws an InputError in the wording of the scene reader where a parameter is out of its range, or several
/// contradict each other. `path`: such as materials.wall.
void validate(const Material& material, std::string_view path);
/// Constructs the model from these parameters after checking them, because its tables depend on them.
template <Model M>
M make(const ParametersOf<M>& parameters, std::string_view path) {
    validate_fields(parameters, path);
    return M(parameters);
}

}  // namespace stilb::materials

namespace stilb {
using materials::Material;
}  // namespace stilb
