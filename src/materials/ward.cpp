#include "materials/ward.h"

#include <algorithm>
#include <cmath>

#include "math/sampling.h"

namespace stilb::materials {
Ward::Ward(const Parameters& parameters)
    : parameters_(parameters),
      cos_rotation_(std::cos(parameters.rotation_deg * kPi / 180)),
      sin_rotation_(std::sin(parameters.rotation_deg * kPi / 180)) {
    const double total = (parameters.diffuse + parameters.specular).luminance();
    diffuse_probability_ = total > 0 ? parameters.diffuse.luminance() / total : 1;
    concentration_ = concentration_at_normal_incidence(*this);
}

Ward::Lobe Ward::lobe(const Vec3& in, const Vec3& out) const {
    constexpr double least = 1e-100;  // below, the powers of h.z underflow; nothing is reflected there
    const Vec3 h = in + out;
    if (h.z < least) return {};
    const auto [roughness_u, roughness_v] = parameters_.roughness;
    const double u = (cos_rotation_ * h.x + sin_rotation_ * h.y) / (roughness_u * h.z);
    const double v = (cos_rotation_ * h.y - sin_rotation_ * h.x) / (roughness_v * h.z);
    const double exponential = std::exp(-(u * u + v * v)) / (kPi * roughness_u * roughness_v);
    const double spread = squared_length(h) / (h.z * h.z) * exponential;
    return {spread / (h.z * h.z), spread / (2 * h.z)};
}

Rgb Ward::brdf_of_lobe_per_sr(const Lobe& lobe) const {
    return parameters_.diffuse * std::numbers::inv_pi + parameters_.specular * lobe.brdf_per_sr;
}

double Ward::pdf_of_lobe_per_sr(const Lobe& lobe, const Vec3& out) const {
    return diffuse_probability_ * math::cosine_hemisphere_pdf_per_sr(out.z) +
           (1 - diffuse_probability_) * lobe.pdf_per_sr;
}

Vec3 Ward::mirrored_at_drawn_facet(const Vec3& in, double u1, double u2) const {
    const double slope = std::sqrt(-std::log1p(-u1));
    const double u = parameters_.roughness[0] * slope * std::cos(2 * kPi * u2);
    const double v = parameters_.roughness[1] * slope * std::sin(2 * kPi * u2);
    const Vec3 facet{cos_rotation_ * u - sin_rotation_ * v, sin_rotation_ * u + cos_rotation_ * v, 1};
    return normalized(reflected(in, normalized(facet)));
}

std::optional<ScatterSample> Ward::sample(const Vec3& in, double u1, double u2) const {
    if (reflectance_bound().max() <= 0) return std::nullopt;
    Vec3 out;
    if (u1 < diffuse_probability_) {
        out = math::sample_cosine_hemisphere(u1 / diffuse_probability_, u2).direction;
    } else {
        const double u_lobe = (u1 - diffuse_probability_) / (1 - diffuse_probability_);
        out = mirrored_at_drawn_facet(in, std::min(u_lobe, math::kBelowOne), u2);
    }
    if (out.z <= 0) return std::nullopt;
    const Lobe both = lobe(in, out);
    const double density = pdf_of_lobe_per_sr(both, out);
    if (density <= 0) return std::nullopt;
    return ScatterSample{out, brdf_of_lobe_per_sr(both) * (out.z / density), density};
}

}  // namespace stilb::materials
