// Plastic, paint, varnished wood: a clear rough coat over a diffuse base.
#pragma once

#include "materials/albedo_table.h"
#include "materials/ggx.h"
#include "materials/model.h"

namespace stilb::materials {

/// f = F D G2 / (4 cos cos) + diffuse T(in) T(out) / (pi n^2 (1 - diffuse F_in)), where T = 1 - (the albedo
/// of the first term), n = ior, and F_in = 1 - T_avg / n^2 is the share of diffuse light from within that the
/// coat reflects back to the base: Saunderson's correction (1942) with rough transmissions, made reciprocal.
/// Light that is reflected between the coat's facets counts as transmitted. A white base loses nothing.
class Plastic {
  public:
    struct Parameters {
        Rgb diffuse;
        double ior = 1.5;
        double roughness = 0.1;

        static constexpr auto fields() {
            return std::tuple{
                Field{"diffuse", &Parameters::diffuse, kReflectance,
                      "reflectance of the base, as it would be without the coat"},
                Field{"ior", &Parameters::ior, kIor, "refractive index of the coat"},
                Field{"roughness", &Parameters::roughness, kRoughness, "alpha of GGX, of the coat"}};
        }
    };
    static constexpr std::string_view kType = "plastic";

    explicit Plastic(const Parameters& parameters);

    const Parameters& parameters() const { return parameters_; }
    double concentration() const { return concentration_; }
    /// The albedo under uniform illumination.
    Rgb mean_reflectance() const;
    Rgb reflectance_bound() const { return mean_reflectance(); }

    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_per_sr(const Vec3& in, const Vec3& out) const;
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const;
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;

  private:
    /// `through_in` and `through_out`: T under both directions.
    Rgb brdf_by_facet_per_sr(const Vec3& in, const Vec3& out, const Vec3& half, double through_in,
                             double through_out) const;
    /// The probability of sampling the coat's lobe: its share of the luminance.
    double coat_probability(double through) const;
    double pdf_by_facet_per_sr(const Vec3& in, const Vec3& out, const Vec3& half,
                               double coat_probability) const;

    Parameters parameters_;
    Ggx facets_;
    AlbedoTable transmission_;  ///< T
    /// The share of the light transmitted by the coat that leaves it again.
    Rgb base_;
    double concentration_ = 0;
};

}  // namespace stilb::materials

namespace stilb {
using materials::Plastic;
}  // namespace stilb
