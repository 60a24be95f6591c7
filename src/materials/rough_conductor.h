// Rough metal: GGX facets that reflect every colour by a constant share, with the light that facets reflect
// more than once.
#pragma once

#include <optional>

#include "materials/albedo_table.h"
#include "materials/ggx.h"
#include "materials/scatter_sample.h"

namespace stilb::materials {

/// f = R D G2 / (4 cos cos) + M (1 - E(in)) (1 - E(out)) / (pi (1 - E_avg)), with E the albedo of white
/// facets that light meets once, and M = R^2 E_avg / (1 - R (1 - E_avg)): [Kulla, Conty 2017, Revisiting
/// physically based shading at Imageworks, p. 11 to 23], the colour of the second term by the geometric
/// series of [Turquin 2019 (11)]. Reciprocal; a white one reflects all light but for the error of the table
/// of E.
class RoughConductor {
  public:
    /// Reflectance R of the facets in [0, 1], the same at all angles; roughness = alpha of GGX, about the
    /// slope of the facets, from 0.001 to 1.
    RoughConductor(const Rgb& reflectance, double roughness);

    const Rgb& reflectance() const { return reflectance_; }
    double roughness() const { return facets_.alpha(); }
    double concentration() const { return concentration_; }

    /// As the functions of material.h, for directions above the surface.
    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_per_sr(const Vec3& in, const Vec3& out) const;
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;

  private:
    /// Of drawing from the light that is reflected more than once, whose share of a white one's albedo it is.
    double multiple_probability(const Vec3& in) const;

    Rgb reflectance_;
    Ggx facets_;
    AlbedoTable loss_;  ///< 1 - E
    Rgb multiple_;      ///< M
    double concentration_ = 0;
};

}  // namespace stilb::materials

namespace stilb {
using materials::RoughConductor;
}  // namespace stilb
