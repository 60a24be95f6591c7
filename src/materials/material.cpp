#include "materials/material.h"

#include <algorithm>

#include "math/sampling.h"

namespace stilb::materials {
namespace {

/// Probability of drawing from the diffuse part; nothing where the material reflects nothing. In proportion
/// to luminance, so that the luminance of a weighted sample stays near the albedo.
std::optional<double> diffuse_probability(const Phong& material) {
    const double diffuse = material.diffuse.luminance();
    const double total = diffuse + material.specular.luminance();
    if (total <= 0) return std::nullopt;
    return diffuse / total;
}

double pdf(const Diffuse&, const Vec3&, const Vec3& out) { return math::cosine_hemisphere_pdf_per_sr(out.z); }

double pdf(const Phong& material, const Vec3& in, const Vec3& out) {
    const std::optional<double> diffuse = diffuse_probability(material);
    if (!diffuse) return 0;
    const double lobe_per_sr =
        (material.exponent + 1) / (2 * std::numbers::pi) * phong_lobe(material, in, out);
    return *diffuse * math::cosine_hemisphere_pdf_per_sr(out.z) + (1 - *diffuse) * lobe_per_sr;
}

/// Rough, Ward, Plastic: classes that know their own.
template <typename Own>
double pdf(const Own& material, const Vec3& in, const Vec3& out) {
    return material.pdf_per_sr(in, out);
}
double pdf(const Mirror&, const Vec3&, const Vec3&) { return 0; }
double pdf(const Dielectric&, const Vec3&, const Vec3&) { return 0; }
double pdf(const ThinDielectric&, const Vec3&, const Vec3&) { return 0; }
double pdf(const Black&, const Vec3&, const Vec3&) { return 0; }

std::optional<ScatterSample> sample(const Diffuse& material, const Vec3&, double u1, double u2) {
    const math::DirectionSample drawn = math::sample_cosine_hemisphere(u1, u2);
    if (drawn.direction.z <= 0) return std::nullopt;
    return ScatterSample{drawn.direction, material.reflectance, drawn.pdf_per_sr};
}

std::optional<ScatterSample> sample(const Phong& material, const Vec3& in, double u1, double u2) {
    const std::optional<double> diffuse = diffuse_probability(material);
    if (!diffuse) return std::nullopt;
    Vec3 out;
    if (u1 < *diffuse) {
        out = math::sample_cosine_hemisphere(u1 / *diffuse, u2).direction;
    } else {
        const double u_lobe = std::min((u1 - *diffuse) / (1 - *diffuse), math::kBelowOne);
        const Frame lobe = Frame::around({-in.x, -in.y, in.z});
        out = lobe.to_world(math::sample_cosine_power(material.exponent, u_lobe, u2).direction);
    }
    if (out.z <= 0) return std::nullopt;
    const double density = pdf(material, in, out);
    if (density <= 0) return std::nullopt;
    return ScatterSample{out, evaluate_brdf_per_sr(material, in, out) * (out.z / density), density};
}

template <typename Own>
std::optional<ScatterSample> sample(const Own& material, const Vec3& in, double u1, double u2) {
    return material.sample(in, u1, u2);
}

std::optional<ScatterSample> sample(const Mirror&, const Vec3&, double, double) { return std::nullopt; }
std::optional<ScatterSample> sample(const Dielectric&, const Vec3&, double, double) { return std::nullopt; }
std::optional<ScatterSample> sample(const ThinDielectric&, const Vec3&, double, double) {
    return std::nullopt;
}
std::optional<ScatterSample> sample(const Black&, const Vec3&, double, double) { return std::nullopt; }

double concentration(const Diffuse& material) { return material.reflectance.max() > 0 ? 1 : 0; }
/// Exact for grey ones at normal incidence, where pi f of the lobe is (n+2)/2 cos^n and its own light sees
/// (n+2)^2 / (4 (n+1)) of it on average; what the lobe sees of the diffuse part, and the reverse, is 1.
double concentration(const Phong& material) {
    const double diffuse = material.diffuse.luminance(), specular = material.specular.luminance();
    if (!(diffuse + specular > 0)) return 0;
    const double share = specular / (diffuse + specular), n = material.exponent;
    return 1 + share * share * ((n + 2) * (n + 2) / (4 * (n + 1)) - 1);
}
template <typename Own>
double concentration(const Own& material) {
    return material.concentration();
}
double concentration(const Mirror&) { return 0; }
double concentration(const Dielectric&) { return 0; }
double concentration(const ThinDielectric&) { return 0; }
double concentration(const Black&) { return 0; }

Rgb bound(const Diffuse& material) { return material.reflectance; }
Rgb bound(const Phong& material) { return material.diffuse + material.specular; }
Rgb bound(const RoughConductor& material) { return material.reflectance(); }
Rgb bound(const Ward& material) { return material.diffuse() + material.specular(); }
Rgb bound(const Plastic& material) { return material.mean_reflectance(); }
Rgb bound(const Mirror& material) { return material.reflectance; }
Rgb bound(const Dielectric&) { return Rgb::grey(1); }
Rgb bound(const ThinDielectric&) { return Rgb::grey(1); }
Rgb bound(const Black&) { return {}; }

}  // namespace

std::optional<ScatterSample> sample_brdf(const Material& material, const Vec3& in, double u1, double u2) {
    if (in.z <= 0) return std::nullopt;
    return std::visit([&](const auto& m) { return sample(m, in, u1, u2); }, material);
}

double pdf_per_sr(const Material& material, const Vec3& in, const Vec3& out) {
    if (in.z <= 0 || out.z <= 0) return 0;
    return std::visit([&](const auto& m) { return pdf(m, in, out); }, material);
}

double mean_concentration(const Material& material) {
    return std::visit([](const auto& m) { return concentration(m); }, material);
}

bool is_specular(const Material& material) {
    return std::holds_alternative<Mirror>(material) || std::holds_alternative<Dielectric>(material) ||
           std::holds_alternative<ThinDielectric>(material);
}

SpecularBranches specular_branches(const Material& material, LightSide side, const Vec3& in) {
    if (in.z <= 0) return {};
    if (const auto* mirror = std::get_if<Mirror>(&material)) return specular_branches(*mirror, side, in);
    if (const auto* glass = std::get_if<Dielectric>(&material)) return specular_branches(*glass, side, in);
    if (const auto* pane = std::get_if<ThinDielectric>(&material)) return specular_branches(*pane, side, in);
    return {};
}

Rgb reflectance_bound(const Material& material) {
    return std::visit([](const auto& m) { return bound(m); }, material);
}

}  // namespace stilb::materials
