// Plastic, paint, varnished wood: a clear rough coat over a diffuse base.
#pragma once

#include <algorithm>

#include "materials/dielectric.h"
#include "materials/facets/albedo_table.h"
#include "materials/facets/ggx.h"
#include "materials/model.h"
#include "math/sampling.h"

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
    /// T by the cosine.
    const AlbedoTable& facet_table() const { return transmission_; }
    /// The albedo under uniform illumination.
    Rgb mean_reflectance() const;
    Rgb reflectance_bound() const { return mean_reflectance(); }

    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_per_sr(const Vec3& in, const Vec3& out) const;
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const;
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;

  private:
    static double transmission_at(const Ggx& facets, double ior, double cosine) {
        const double reflectance =
            mean_over_visible_normals(facets, cosine, [&](const Vec3& in, const Vec3& normal) {
                const Vec3 out = reflected(in, normal);
                if (out.z <= 0) return 0.0;
                return fresnel_reflectance(dot(in, normal), ior).unpolarised() * facets.passing(in, out);
            });
        return 1 - reflectance;
    }

    static const AlbedoTable& transmission_table(const Ggx& facets, const Parameters& parameters) {
        thread_local LastAlbedoTable last;
        return last.get({parameters.roughness, parameters.ior},
                        [&](double cosine) { return transmission_at(facets, parameters.ior, cosine); });
    }

    static Rgb reflectance_from_within(const Rgb& diffuse, double coat_from_within) {
        Rgb result;
        for (std::size_t b = 0; b < kBands; ++b) {
            result[b] = diffuse[b] * (1 - coat_from_within) / (1 - diffuse[b] * coat_from_within);
        }
        return result;
    }

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

inline Plastic::Plastic(const Parameters& parameters)
    : parameters_(parameters),
      facets_(parameters.roughness),
      transmission_(transmission_table(facets_, parameters)),
      base_(reflectance_from_within(parameters.diffuse,
                                    1 - transmission_.average() / (parameters.ior * parameters.ior))) {
    concentration_ = concentration_at_normal_incidence(*this);
}

inline Rgb Plastic::mean_reflectance() const {
    return Rgb::grey(1 - transmission_.average()) + transmission_.average() * base_;
}

inline double Plastic::coat_probability(double through) const {
    const double total = 1 - through + through * base_.luminance();
    return total > 0 ? (1 - through) / total : 0;
}

inline Rgb Plastic::brdf_by_facet_per_sr(const Vec3& in, const Vec3& out, const Vec3& half, double through_in,
                                         double through_out) const {
    const double coat = fresnel_reflectance(dot(in, half), parameters_.ior).unpolarised() *
                        facets_.brdf_per_sr(in, out, half);
    const double through = through_in * through_out / (kPi * transmission_.average());
    return Rgb::grey(coat) + base_ * through;
}

inline double Plastic::pdf_by_facet_per_sr(const Vec3& in, const Vec3& out, const Vec3& half,
                                           double coat) const {
    return coat * facets_.pdf_per_sr(in, half) + (1 - coat) * math::cosine_hemisphere_pdf_per_sr(out.z);
}

inline Rgb Plastic::brdf_per_sr(const Vec3& in, const Vec3& out) const {
    return brdf_by_facet_per_sr(in, out, half_vector(in, out), transmission_.at(in.z),
                                transmission_.at(out.z));
}

inline double Plastic::pdf_per_sr(const Vec3& in, const Vec3& out) const {
    return pdf_by_facet_per_sr(in, out, half_vector(in, out), coat_probability(transmission_.at(in.z)));
}

inline ScatterValue Plastic::evaluate(const Vec3& in, const Vec3& out) const {
    const Vec3 half = half_vector(in, out);
    const double through_in = transmission_.at(in.z), through_out = transmission_.at(out.z);
    return {brdf_by_facet_per_sr(in, out, half, through_in, through_out),
            pdf_by_facet_per_sr(out, in, half, coat_probability(through_out))};
}

inline std::optional<ScatterSample> Plastic::sample(const Vec3& in, double u1, double u2) const {
    const double through = transmission_.at(in.z), coat = coat_probability(through);
    Vec3 out;
    if (u1 < coat) {
        out = normalized(reflected(in, facets_.visible_normal(in, math::sample_unit_disk(u1 / coat, u2))));
    } else {
        out =
            math::sample_cosine_hemisphere(std::min((u1 - coat) / (1 - coat), math::kBelowOne), u2).direction;
    }
    if (out.z <= 0) return std::nullopt;
    const Vec3 half = half_vector(in, out);
    const double density = pdf_by_facet_per_sr(in, out, half, coat);
    const Rgb brdf = brdf_by_facet_per_sr(in, out, half, through, transmission_.at(out.z));
    return ScatterSample{out, brdf * (out.z / density), density};
}

}  // namespace stilb::materials

namespace stilb {
using materials::Plastic;
}  // namespace stilb
