// Gloss as a power of the cosine, with a diffuse part.
#pragma once

#include <algorithm>
#include <cmath>

#include "materials/model.h"
#include "math/sampling.h"

namespace stilb::materials {

/// Energy-normalised modified Phong: f = diffuse/pi + specular (n+2)/(2 pi) cos+^n(alpha), where alpha is the
/// angle to the mirrored direction and n the exponent; diffuse + specular <= 1 in every band.
struct Phong {
    Rgb diffuse;
    Rgb specular;
    double exponent = 1;

    static constexpr std::string_view kType = "phong";
    static constexpr auto fields() {
        return std::tuple{
            Field{"diffuse", &Phong::diffuse, kReflectance, "share that is reflected diffusely"},
            Field{"specular", &Phong::specular, kReflectance, "share in the lobe, at normal incidence"},
            Field{"exponent", &Phong::exponent, kExponent, "of the lobe: the higher, the narrower"}};
    }
    std::optional<std::string> contradiction() const { return contradiction_of_shares(diffuse, specular); }

    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const { return brdf_of_lobe_per_sr(lobe(in, out)); }
    double pdf_per_sr(const Vec3& in, const Vec3& out) const {
        return pdf_of_lobe_per_sr(lobe(in, out), out);
    }
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const {
        const double value = lobe(in, out);
        return {brdf_of_lobe_per_sr(value), pdf_of_lobe_per_sr(value, in)};
    }
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;
    /// Exact for grey materials at normal incidence, where pi f of the lobe is (n+2)/2 cos^n, whose mean over
    /// the lobe's own light is (n+2)^2 / (4 (n+1)); the mean of the diffuse part over the lobe, and the
    /// reverse, is 1.
    double concentration() const;
    Rgb reflectance_bound() const { return diffuse + specular; }

  private:
    static constexpr Range kExponent{0, 1e6, "from 0 to 1e6"};

    /// cos+^n(alpha): the unnormalised lobe.
    double lobe(const Vec3& in, const Vec3& out) const {
        const double cos_alpha = in.z * out.z - in.x * out.x - in.y * out.y;
        return cos_alpha > 0 ? std::pow(cos_alpha, exponent) : 0;
    }
    Rgb brdf_of_lobe_per_sr(double lobe) const {
        const double lobe_per_sr = (exponent + 2) / (2 * std::numbers::pi) * lobe;
        return diffuse * std::numbers::inv_pi + specular * lobe_per_sr;
    }
    double pdf_of_lobe_per_sr(double lobe, const Vec3& out) const;
    /// Probability of sampling the diffuse part; nothing where the material reflects nothing. In
    /// proportion to luminance, so that the luminance of a weighted sample stays near the albedo.
    std::optional<double> diffuse_probability() const;
};

inline std::optional<double> Phong::diffuse_probability() const {
    const double diffuse_luminance = diffuse.luminance();
    const double total = diffuse_luminance + specular.luminance();
    if (total <= 0) return std::nullopt;
    return diffuse_luminance / total;
}

inline double Phong::pdf_of_lobe_per_sr(double lobe, const Vec3& out) const {
    const std::optional<double> of_diffuse = diffuse_probability();
    if (!of_diffuse) return 0;
    const double lobe_per_sr = (exponent + 1) / (2 * std::numbers::pi) * lobe;
    return *of_diffuse * math::cosine_hemisphere_pdf_per_sr(out.z) + (1 - *of_diffuse) * lobe_per_sr;
}

inline std::optional<ScatterSample> Phong::sample(const Vec3& in, double u1, double u2) const {
    const std::optional<double> of_diffuse = diffuse_probability();
    if (!of_diffuse) return std::nullopt;
    Vec3 out;
    if (u1 < *of_diffuse) {
        out = math::sample_cosine_hemisphere(u1 / *of_diffuse, u2).direction;
    } else {
        const double u_lobe = std::min((u1 - *of_diffuse) / (1 - *of_diffuse), math::kBelowOne);
        out = Frame::around(mirrored(in)).to_world(math::sample_cosine_power(exponent, u_lobe, u2).direction);
    }
    if (out.z <= 0) return std::nullopt;
    const double value = lobe(in, out);
    const double density = pdf_of_lobe_per_sr(value, out);
    if (density <= 0) return std::nullopt;
    return ScatterSample{out, brdf_of_lobe_per_sr(value) * (out.z / density), density};
}

inline double Phong::concentration() const {
    const double diffuse_luminance = diffuse.luminance(), specular_luminance = specular.luminance();
    if (!(diffuse_luminance + specular_luminance > 0)) return 0;
    const double share = specular_luminance / (diffuse_luminance + specular_luminance), n = exponent;
    return 1 + share * share * ((n + 2) * (n + 2) / (4 * (n + 1)) - 1);
}

}  // namespace stilb::materials

namespace stilb {
using materials::Phong;
}  // namespace stilb
