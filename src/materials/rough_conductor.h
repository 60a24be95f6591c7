// Rough metal: GGX facets with a constant reflectance, including multiple reflection between
// facets.
#pragma once

#include "materials/albedo_table.h"
#include "materials/ggx.h"
#include "materials/model.h"

namespace stilb::materials {

/// f = R D G2 / (4 cos cos) + M (1 - E(in)) (1 - E(out)) / (pi (1 - E_avg)), with E the single-scattering
/// albedo of white facets, and M = R^2 E_avg / (1 - R (1 - E_avg)): [Kulla, Conty 2017, Revisiting physically
/// based shading at Imageworks, p. 11 to 23], the colour of the second term by the geometric series of
/// [Turquin 2019 (11)]. Reciprocal; a white one reflects all light except for the error of the table of E.
class RoughConductor {
  public:
    struct Parameters {
        Rgb reflectance;  ///< R
        double roughness = 0.1;

        static constexpr auto fields() {
            return std::tuple{Field{"reflectance", &Parameters::reflectance, kReflectance,
                                    "of the facets, the same at all angles"},
                              Field{"roughness", &Parameters::roughness, kRoughness,
                                    "alpha of GGX, about the slope of the facets"}};
        }
    };
    static constexpr std::string_view kType = "rough";

    explicit RoughConductor(const Parameters& parameters);

    const Parameters& parameters() const { return parameters_; }
    double concentration() const { return concentration_; }
    Rgb reflectance_bound() const { return parameters_.reflectance; }

    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_per_sr(const Vec3& in, const Vec3& out) const;
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const;
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;

  private:
    /// `loss_in` and `loss_out`: values of the table for both directions. `loss_in` is the probability of
    /// sampling the multiply reflected light, because it is its share of the albedo of a white material.
    Rgb brdf_by_facet_per_sr(const Vec3& in, const Vec3& out, const Vec3& half, double loss_in,
                             double loss_out) const;
    double pdf_by_facet_per_sr(const Vec3& in, const Vec3& out, const Vec3& half, double loss_in) const;

    Parameters parameters_;
    Ggx facets_;
    AlbedoTable loss_;  ///< 1 - E
    Rgb multiple_;      ///< M
    double concentration_ = 0;
};

}  // namespace stilb::materials

namespace stilb {
using materials::RoughConductor;
}  // namespace stilb
