// Rough metal: GGX facets with a constant reflectance, including multiple reflection between
// facets.
#pragma once

#include <algorithm>

#include "materials/facets/albedo_table.h"
#include "materials/facets/ggx.h"
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
    /// 1 - E by the cosine.
    const AlbedoTable& facet_table() const { return loss_; }
    Rgb reflectance_bound() const { return parameters_.reflectance; }

    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_per_sr(const Vec3& in, const Vec3& out) const;
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const;
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;

  private:
    /// Share of the light from this direction that remains between white facets after the first reflection.
    static double loss_at(const Ggx& facets, double cosine) {
        return mean_over_visible_normals(facets, cosine, [&](const Vec3& in, const Vec3& normal) {
            const Vec3 out = reflected(in, normal);
            return out.z > 0 ? 1 - facets.passing(in, out) : 1;
        });
    }

    static const AlbedoTable& loss_table(const Ggx& facets, double roughness) {
        thread_local LastAlbedoTable last;
        return last.get({roughness, 0}, [&](double cosine) { return loss_at(facets, cosine); });
    }

    static Rgb multiple_reflectance(const Rgb& reflectance, double lost) {
        Rgb result;
        for (std::size_t b = 0; b < kBands; ++b) {
            result[b] = reflectance[b] * reflectance[b] * (1 - lost) / (1 - reflectance[b] * lost);
        }
        return result;
    }

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

inline RoughConductor::RoughConductor(const Parameters& parameters)
    : parameters_(parameters),
      facets_(parameters.roughness),
      loss_(loss_table(facets_, parameters.roughness)),
      multiple_(multiple_reflectance(parameters.reflectance, loss_.average())) {
    concentration_ = concentration_at_normal_incidence(*this);
}

inline Rgb RoughConductor::brdf_by_facet_per_sr(const Vec3& in, const Vec3& out, const Vec3& half,
                                                double loss_in, double loss_out) const {
    const double once = facets_.brdf_per_sr(in, out, half);
    const double more = loss_in * loss_out / (kPi * loss_.average());
    return parameters_.reflectance * once + multiple_ * more;
}

inline double RoughConductor::pdf_by_facet_per_sr(const Vec3& in, const Vec3& out, const Vec3& half,
                                                  double loss_in) const {
    return (1 - loss_in) * facets_.pdf_per_sr(in, half) + loss_in * loss_.pdf_per_sr(out.z);
}

inline Rgb RoughConductor::brdf_per_sr(const Vec3& in, const Vec3& out) const {
    return brdf_by_facet_per_sr(in, out, half_vector(in, out), loss_.at(in.z), loss_.at(out.z));
}

inline double RoughConductor::pdf_per_sr(const Vec3& in, const Vec3& out) const {
    return pdf_by_facet_per_sr(in, out, half_vector(in, out), loss_.at(in.z));
}

inline ScatterValue RoughConductor::evaluate(const Vec3& in, const Vec3& out) const {
    const Vec3 half = half_vector(in, out);
    const double loss_in = loss_.at(in.z), loss_out = loss_.at(out.z);
    return {brdf_by_facet_per_sr(in, out, half, loss_in, loss_out),
            pdf_by_facet_per_sr(out, in, half, loss_out)};
}

inline std::optional<ScatterSample> RoughConductor::sample(const Vec3& in, double u1, double u2) const {
    if (parameters_.reflectance.max() <= 0) return std::nullopt;
    const double multiple = loss_.at(in.z);
    Vec3 out;
    if (u1 < multiple) {
        out = loss_.sample(u1 / multiple, u2);
    } else {
        const double u_facet = std::min((u1 - multiple) / (1 - multiple), math::kBelowOne);
        out = normalized(reflected(in, facets_.visible_normal(in, math::sample_unit_disk(u_facet, u2))));
    }
    if (out.z <= 0) return std::nullopt;
    const Vec3 half = half_vector(in, out);
    const double density = pdf_by_facet_per_sr(in, out, half, multiple);
    const Rgb brdf = brdf_by_facet_per_sr(in, out, half, multiple, loss_.at(out.z));
    return ScatterSample{out, brdf * (out.z / density), density};
}

}  // namespace stilb::materials

namespace stilb {
using materials::RoughConductor;
}  // namespace stilb
