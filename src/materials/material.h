// Materials: how surfaces scatter light.
//
// This file does not include the models: what uses one includes its file, what visits all includes
// model_list.h. Directions are those of model.h. Formulas and limits: docs/materials.md.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "materials/model.h"

namespace stilb::materials {

/// Different for each type.
template <typename M>
inline constexpr char kIdentity = 0;

/// One of the models of model_list.h, as a value. Copies share it, for a model does not change.
class Material {
  public:
    template <Model M>
    Material(const M& model) : model_(std::make_shared<const M>(model)), identity_(&kIdentity<M>) {}
    /// Diffuse, and reflects nothing.
    Material();

    template <Model M>
    bool is() const {
        return identity_ == &kIdentity<M>;
    }
    /// The model where it is an M, else nothing.
    template <Model M>
    const M* get_if() const {
        return is<M>() ? static_cast<const M*>(model_.get()) : nullptr;
    }

  private:
    std::shared_ptr<const void> model_;
    const char* identity_;
};

/// One of the ways in which light leaves a surface. A path meets it on one side of the surface, and goes on
/// from there, or, where the lobe crosses, from the other side. Then `scattering` describes it as if it were
/// reflection: by the place on the other side, and the direction of the path, mirrored at the surface
/// (Hit::behind() and mirrored() of rays/ray_caster.h). So all that knows reflection knows transmission, too.
struct Lobe {
    Material scattering;  ///< not composed itself
    bool crosses = false;
    /// The refractive index of the side where the path goes on over that of the side where it came from. The
    /// lobe's light is this times as much for particles, and divided by it for paths that carry luminance,
    /// which is as n^2; in between lies what is the same in both directions.
    double far_over_near = 1;

    double factor(Carried carried) const {
        return carried == Carried::flux ? far_over_near : 1 / far_over_near;
    }
};
/// The lobes by which a path that meets the surface on this side goes on. Empty for materials that are not
/// composed: these are their own only lobe.
std::span<const Lobe> lobes(const Material& material, LightSide side, Carried carried);
bool is_composed(const Material& material);
/// Share of the light from an angle of this cosine that a material, or a lobe, sends on: to choose among
/// lobes. Without a closed expression, the bound.
Rgb sent_on(const Material& material, double cosine);

/// Names of the models in scene files.
std::vector<std::string_view> type_names();
/// The name of this one.
std::string_view type_name(const Material& material);

/// BRDF [1/sr]; 0 for directions below the surface and for materials that do not scatter themselves: those
/// that are specular or composed. Reciprocal.
Rgb evaluate_brdf_per_sr(const Material& material, const Vec3& in, const Vec3& out);

/// Samples a direction from the material's own density, by two numbers in [0, 1); nothing where light is
/// absorbed and for specular materials, whose directions specular_branches() gives.
std::optional<ScatterSample> sample_brdf(const Material& material, const Vec3& in, double u1, double u2);
/// The density of sample_brdf(). Its integral falls short of 1 by the probability of absorption.
double pdf_per_sr(const Material& material, const Vec3& in, const Vec3& out);
/// evaluate_brdf_per_sr(material, in, out) and pdf_per_sr(material, out, in), bit by bit, for the cost
/// of one.
ScatterValue evaluate_and_pdf(const Material& material, const Vec3& in, const Vec3& out);

/// True for mirror, glass and pane: no connection to such a surface is possible. Of composed materials, their
/// lobes may be so.
bool is_specular(const Material& material);
/// The branches in which light from `in` leaves a specular surface; none for other materials.
SpecularBranches specular_branches(const Material& material, LightSide side, const Vec3& in);
/// Whether light gets through the surface.
bool transmits(const Material& material);
/// Whether some of it is scattered on the way.
bool scatters_through(const Material& material);
/// Whether light passes straight through the surface, as shadow rays then do: panes, and lobes that do.
bool passes_straight(const Material& material);
/// Its share of the flux, at an angle of this cosine to the normal; 0 for other materials.
Rgb straight_transmittance(const Material& material, double cosine);

/// The mean of pi f / albedo over the reflected light, roughly: 1 on diffuse surfaces, large where a lobe
/// dominates; 0 for specular materials and where nothing is reflected. Of composed materials: the largest.
double mean_concentration(const Material& material);
/// Largest share of arriving light that is reflected or transmitted, per band (a bound over directions); for
/// plastic, whose share rises to 1 at grazing angles, that of uniform illumination.
Rgb reflectance_bound(const Material& material);
/// The reflectance in reports: the bound, except for specular materials, whose value is that at normal
/// incidence.
Rgb stated_reflectance(const Material& material);

/// Why two materials cannot be the front and the back of a surface; nothing where they can. What passes from
/// one side to the other must be the same as what passes back.
std::optional<std::string> contradiction_of_sides(const Material& front, const Material& back);

/// Throws an InputError in the wording of the scene reader where a parameter is out of its range, or several
/// contradict each other. `path`: such as materials.wall.
void validate(const Material& material, std::string_view path);

}  // namespace stilb::materials

namespace stilb {
using materials::Material;
}  // namespace stilb
