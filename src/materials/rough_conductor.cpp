#include "materials/rough_conductor.h"

#include <algorithm>

namespace stilb::materials {
namespace {

/// Share of the light from this direction that remains between white facets after the first reflection.
double loss_at(const Ggx& facets, double cosine) {
    return mean_over_visible_normals(facets, cosine, [&](const Vec3& in, const Vec3& normal) {
        const Vec3 out = reflected(in, normal);
        return out.z > 0 ? 1 - facets.passing(in, out) : 1;
    });
}

Rgb multiple_reflectance(const Rgb& reflectance, double lost) {
    Rgb result;
    for (std::size_t b = 0; b < kBands; ++b) {
        result[b] = reflectance[b] * reflectance[b] * (1 - lost) / (1 - reflectance[b] * lost);
    }
    return result;
}

}  // namespace

RoughConductor::RoughConductor(const Parameters& parameters)
    : parameters_(parameters),
      facets_(parameters.roughness),
      loss_(parameters.roughness, [this](double cosine) { return loss_at(facets_, cosine); }),
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
    return (1 - loss_in) * facets_.pdf_per_sr(in, half) + loss_in * loss_.pdf_of_cosine(out.z) / (2 * kPi);
}

Rgb RoughConductor::brdf_per_sr(const Vec3& in, const Vec3& out) const {
    return brdf_by_facet_per_sr(in, out, half_vector(in, out), loss_.at(in.z), loss_.at(out.z));
}

double RoughConductor::pdf_per_sr(const Vec3& in, const Vec3& out) const {
    return pdf_by_facet_per_sr(in, out, half_vector(in, out), loss_.at(in.z));
}

ScatterValue RoughConductor::evaluate(const Vec3& in, const Vec3& out) const {
    const Vec3 half = half_vector(in, out);
    const double loss_in = loss_.at(in.z), loss_out = loss_.at(out.z);
    return {brdf_by_facet_per_sr(in, out, half, loss_in, loss_out),
            pdf_by_facet_per_sr(out, in, half, loss_out)};
}

std::optional<ScatterSample> RoughConductor::sample(const Vec3& in, double u1, double u2) const {
    if (parameters_.reflectance.max() <= 0) return std::nullopt;
    const double multiple = loss_.at(in.z);
    Vec3 out;
    if (u1 < multiple) {
        const double cosine = loss_.sample_cosine(u1 / multiple);
        const double sine = std::sqrt((1 - cosine) * (1 + cosine)), phi = 2 * kPi * u2;
        out = {sine * std::cos(phi), sine * std::sin(phi), cosine};
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
