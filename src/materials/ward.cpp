#include "materials/ward.h"

#include <algorithm>

#include "materials/concentration.h"
#include "math/sampling.h"

namespace stilb::materials {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

Ward::Ward(const Rgb& diffuse, const Rgb& specular, const Roughness& roughness, double rotation_deg)
    : diffuse_(diffuse),
      specular_(specular),
      roughness_(roughness),
      rotation_deg_(rotation_deg),
      cos_rotation_(std::cos(rotation_deg * kPi / 180)),
      sin_rotation_(std::sin(rotation_deg * kPi / 180)) {
    const double total = (diffuse + specular).luminance();
    diffuse_probability_ = total > 0 ? diffuse.luminance() / total : 1;
    concentration_ = concentration_at_normal_incidence(*this);
}

Ward::Lobe Ward::lobe(const Vec3& in, const Vec3& out) const {
    constexpr double least = 1e-100;  // below, the powers of h.z underflow; nothing is reflected there
    const Vec3 h = in + out;
    if (h.z < least) return {};
    const double u = (cos_rotation_ * h.x + sin_rotation_ * h.y) / (roughness_.u * h.z);
    const double v = (cos_rotation_ * h.y - sin_rotation_ * h.x) / (roughness_.v * h.z);
    const double exponential = std::exp(-(u * u + v * v)) / (kPi * roughness_.u * roughness_.v);
    const double spread = squared_length(h) / (h.z * h.z) * exponential;
    return {spread / (h.z * h.z), spread / (2 * h.z)};
}

Rgb Ward::brdf_per_sr(const Vec3& in, const Vec3& out) const {
    return diffuse_ * std::numbers::inv_pi + specular_ * lobe(in, out).brdf_per_sr;
}

double Ward::pdf_per_sr(const Vec3& in, const Vec3& out) const {
    return diffuse_probability_ * math::cosine_hemisphere_pdf_per_sr(out.z) +
           (1 - diffuse_probability_) * lobe(in, out).pdf_per_sr;
}

Vec3 Ward::mirrored_at_drawn_facet(const Vec3& in, double u1, double u2) const {
    const double slope = std::sqrt(-std::log1p(-u1));
    const double u = roughness_.u * slope * std::cos(2 * kPi * u2);
    const double v = roughness_.v * slope * std::sin(2 * kPi * u2);
    const Vec3 facet{cos_rotation_ * u - sin_rotation_ * v, sin_rotation_ * u + cos_rotation_ * v, 1};
    return normalized(reflected(in, normalized(facet)));
}

std::optional<ScatterSample> Ward::sample(const Vec3& in, double u1, double u2) const {
    if ((diffuse_ + specular_).max() <= 0) return std::nullopt;
    Vec3 out;
    if (u1 < diffuse_probability_) {
        out = math::sample_cosine_hemisphere(u1 / diffuse_probability_, u2).direction;
    } else {
        const double u_lobe = (u1 - diffuse_probability_) / (1 - diffuse_probability_);
        out = mirrored_at_drawn_facet(in, std::min(u_lobe, math::kBelowOne), u2);
    }
    if (out.z <= 0) return std::nullopt;
    const double density = pdf_per_sr(in, out);
    if (density <= 0) return std::nullopt;
    return ScatterSample{out, brdf_per_sr(in, out) * (out.z / density), density};
}

}  // namespace stilb::materials
