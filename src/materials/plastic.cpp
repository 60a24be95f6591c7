#include "materials/plastic.h"

#include <algorithm>

#include "materials/concentration.h"
#include "materials/dielectric.h"
#include "math/sampling.h"

namespace stilb::materials {
namespace {

constexpr double kPi = std::numbers::pi;

double transmission_at(const Ggx& facets, double ior, double cosine) {
    const double reflectance =
        mean_over_visible_normals(facets, cosine, [&](const Vec3& in, const Vec3& normal) {
            const Vec3 out = reflected(in, normal);
            if (out.z <= 0) return 0.0;
            return fresnel_reflectance(dot(in, normal), ior).unpolarised() * facets.passing(in, out);
        });
    return 1 - reflectance;
}

Rgb reflectance_from_within(const Rgb& diffuse, double coat_from_within) {
    Rgb result;
    for (std::size_t b = 0; b < kBands; ++b) {
        result[b] = diffuse[b] * (1 - coat_from_within) / (1 - diffuse[b] * coat_from_within);
    }
    return result;
}

}  // namespace

Plastic::Plastic(const Rgb& diffuse, double ior, double roughness)
    : diffuse_(diffuse),
      ior_(ior),
      facets_(roughness),
      transmission_(roughness, [this](double cosine) { return transmission_at(facets_, ior_, cosine); }),
      base_(reflectance_from_within(diffuse, 1 - transmission_.average() / (ior * ior))) {
    concentration_ = concentration_at_normal_incidence(*this);
}

Rgb Plastic::mean_reflectance() const {
    return Rgb::grey(1 - transmission_.average()) + transmission_.average() * base_;
}

double Plastic::coat_probability(const Vec3& in) const {
    const double through = transmission_.at(in.z);
    const double total = 1 - through + through * base_.luminance();
    return total > 0 ? (1 - through) / total : 0;
}

Rgb Plastic::brdf_per_sr(const Vec3& in, const Vec3& out) const {
    const Vec3 half = half_vector(in, out);
    const double coat =
        fresnel_reflectance(dot(in, half), ior_).unpolarised() * facets_.brdf_per_sr(in, out, half);
    const double through = transmission_.at(in.z) * transmission_.at(out.z) / (kPi * transmission_.average());
    return Rgb::grey(coat) + base_ * through;
}

double Plastic::pdf_per_sr(const Vec3& in, const Vec3& out) const {
    const double coat = coat_probability(in);
    return coat * facets_.pdf_per_sr(in, half_vector(in, out)) +
           (1 - coat) * math::cosine_hemisphere_pdf_per_sr(out.z);
}

std::optional<ScatterSample> Plastic::sample(const Vec3& in, double u1, double u2) const {
    const double coat = coat_probability(in);
    Vec3 out;
    if (u1 < coat) {
        out = normalized(reflected(in, facets_.visible_normal(in, math::sample_unit_disk(u1 / coat, u2))));
    } else {
        out =
            math::sample_cosine_hemisphere(std::min((u1 - coat) / (1 - coat), math::kBelowOne), u2).direction;
    }
    if (out.z <= 0) return std::nullopt;
    const double density = pdf_per_sr(in, out);
    return ScatterSample{out, brdf_per_sr(in, out) * (out.z / density), density};
}

}  // namespace stilb::materials
