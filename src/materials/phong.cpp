#include "materials/phong.h"

#include <algorithm>

#include "math/sampling.h"

namespace stilb::materials {

std::optional<double> Phong::diffuse_probability() const {
    const double diffuse_luminance = diffuse.luminance();
    const double total = diffuse_luminance + specular.luminance();
    if (total <= 0) return std::nullopt;
    return diffuse_luminance / total;
}

double Phong::pdf_of_lobe_per_sr(double lobe, const Vec3& out) const {
    const std::optional<double> of_diffuse = diffuse_probability();
    if (!of_diffuse) return 0;
    const double lobe_per_sr = (exponent + 1) / (2 * std::numbers::pi) * lobe;
    return *of_diffuse * math::cosine_hemisphere_pdf_per_sr(out.z) + (1 - *of_diffuse) * lobe_per_sr;
}

std::optional<ScatterSample> Phong::sample(const Vec3& in, double u1, double u2) const {
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

double Phong::concentration() const {
    const double diffuse_luminance = diffuse.luminance(), specular_luminance = specular.luminance();
    if (!(diffuse_luminance + specular_luminance > 0)) return 0;
    const double share = specular_luminance / (diffuse_luminance + specular_luminance), n = exponent;
    return 1 + share * share * ((n + 2) * (n + 2) / (4 * (n + 1)) - 1);
}

}  // namespace stilb::materials
