#include "materials/rough_conductor.h"

#include <algorithm>

#include "materials/concentration.h"

namespace stilb::materials {
namespace {

constexpr double kPi = std::numbers::pi;

/// Share of the light from this direction that white facets keep among themselves at the first reflection.
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

RoughConductor::RoughConductor(const Rgb& reflectance, double roughness)
    : reflectance_(reflectance),
      facets_(roughness),
      loss_(roughness, [this](double cosine) { return loss_at(facets_, cosine); }),
      multiple_(multiple_reflectance(reflectance, loss_.average())) {
    concentration_ = concentration_at_normal_incidence(*this);
}

double RoughConductor::multiple_probability(const Vec3& in) const { return loss_.at(in.z); }

Rgb RoughConductor::brdf_per_sr(const Vec3& in, const Vec3& out) const {
    const double once = facets_.brdf_per_sr(in, out, half_vector(in, out));
    const double more = loss_.at(in.z) * loss_.at(out.z) / (kPi * loss_.average());
    return reflectance_ * once + multiple_ * more;
}

double RoughConductor::pdf_per_sr(const Vec3& in, const Vec3& out) const {
    const double multiple = multiple_probability(in);
    return (1 - multiple) * facets_.pdf_per_sr(in, half_vector(in, out)) +
           multiple * loss_.pdf_of_cosine(out.z) / (2 * kPi);
}

std::optional<ScatterSample> RoughConductor::sample(const Vec3& in, double u1, double u2) const {
    if (reflectance_.max() <= 0) return std::nullopt;
    const double multiple = multiple_probability(in);
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
    const double density = pdf_per_sr(in, out);
    return ScatterSample{out, brdf_per_sr(in, out) * (out.z / density), density};
}

}  // namespace stilb::materials
