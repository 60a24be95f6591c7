// Plastic, paint, varnished wood: a clear rough coat over a diffuse base.
#pragma once

#include <optional>

#include "materials/albedo_table.h"
#include "materials/ggx.h"
#include "materials/scatter_sample.h"

namespace stilb::materials {

/// f = F D G2 / (4 cos cos) + diffuse T(in) T(out) / (pi n^2 (1 - diffuse F_in)), where T = 1 - (the albedo
/// of the first term), n = ior, and F_in = 1 - T_avg / n^2 is what the coat sends back to the base of diffuse
/// light from within: Saunderson's correction (1942) with rough transmissions, made reciprocal. Light that
/// the coat's facets keep among themselves counts as let through. A white base loses nothing.
class Plastic {
  public:
    /// Reflectance of the base in [0, 1] as it would be without the coat; ior >= 1 of the coat; roughness =
    /// alpha of GGX, from 0.001 to 1.
    Plastic(const Rgb& diffuse, double ior, double roughness);

    const Rgb& diffuse() const { return diffuse_; }
    double ior() const { return ior_; }
    double roughness() const { return facets_.alpha(); }
    double concentration() const { return concentration_; }
    /// The albedo under light from everywhere.
    Rgb mean_reflectance() const;

    /// As the functions of material.h, for directions above the surface.
    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_per_sr(const Vec3& in, const Vec3& out) const;
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;

  private:
    /// Of drawing from the coat's lobe: its share of the luminance.
    double coat_probability(const Vec3& in) const;

    Rgb diffuse_;
    double ior_;
    Ggx facets_;
    AlbedoTable transmission_;  ///< T
    /// What comes out again, of light that the coat has let through.
    Rgb base_;
    double concentration_ = 0;
};

}  // namespace stilb::materials

namespace stilb {
using materials::Plastic;
}  // namespace stilb
