// Lambert's surface: the same luminance in all directions.
#pragma once

#include "materials/model.h"
#include "math/sampling.h"

namespace stilb::materials {

/// f = reflectance / pi.
struct Diffuse {
    Rgb reflectance;

    static constexpr std::string_view kType = "diffuse";
    static constexpr auto fields() {
        return std::tuple{Field{"reflectance", &Diffuse::reflectance, kReflectance,
                                "share of the light that is reflected"}};
    }

    Rgb brdf_per_sr(const Vec3&, const Vec3&) const { return reflectance * std::numbers::inv_pi; }
    double pdf_per_sr(const Vec3&, const Vec3& out) const {
        return math::cosine_hemisphere_pdf_per_sr(out.z);
    }
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const {
        return {brdf_per_sr(in, out), pdf_per_sr(out, in)};
    }
    std::optional<ScatterSample> sample(const Vec3&, double u1, double u2) const {
        const math::DirectionSample drawn = math::sample_cosine_hemisphere(u1, u2);
        if (drawn.direction.z <= 0) return std::nullopt;
        return ScatterSample{drawn.direction, reflectance, drawn.pdf_per_sr};
    }
    double concentration() const { return reflectance.max() > 0 ? 1 : 0; }
    Rgb reflectance_bound() const { return reflectance; }
};

}  // namespace stilb::materials

namespace stilb {
using materials::Diffuse;
}  // namespace stilb
