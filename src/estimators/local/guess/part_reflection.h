// Path tracing of the light that a surface reflects by the parts of its material, each with a share of its
// own.
#pragma once

#include "materials/split_material.h"
#include "transport/path_tracer.h"
#include "transport/weights.h"

namespace stilb::estimators {

/// The k of connections to other vertices over that of connections to the gloss of a material. Without a
/// diffuse part a surface has no guess: its residual is all its light, and close to it few connections, which
/// need a tighter bound, would bring most of that.
inline double split_of_gloss(const materials::SplitMaterial& material) {
    constexpr double without_guess = 10;
    return material.diffuse_reflectance.max() > 0 ? 1 : without_guess;
}

/// What gathering rays add to bounded connections with the surface (weights.h): 1 - w, for a part with
/// relative BRDF s.
class PartShares {
  public:
    /// Without connections, gathering rays add all of the light.
    PartShares() = default;
    PartShares(double g_over_k, const materials::SplitMaterial& material)
        : diffuse_{g_over_k}, gloss_{g_over_k * split_of_gloss(material)} {}

    double diffuse() const { return diffuse_(1); }
    double of_gloss(double relative) const {
        return gloss_(transport::bounding_brdf(relative, transport::VertexChoice::by_kernel));
    }
    double of_mean_gloss(double mean_concentration) const { return gloss_(mean_concentration); }

  private:
    transport::GatheredShare diffuse_, gloss_;
};

/// The probability with which a ray that meets such a surface is continued: about the share of its reflected
/// light for which rays are responsible.
double continuation_probability(const materials::SplitMaterial& material, const PartShares& shares);

/// One sample of the luminance towards `outgoing`, without emission. `channels`: null for none.
transport::LightSum reflected_luminance(const transport::PathTracer& tracer, const rays::Hit& surface,
                                        const Vec3& outgoing, const materials::SplitMaterial& material,
                                        const PartShares& shares, math::SampleStream& stream,
                                        const transport::Channels* channels);

}  // namespace stilb::estimators
