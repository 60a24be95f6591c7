// Path tracing of the light that a surface reflects by the parts of its material, each with a share of its
// own.
#pragma once

#include "materials/split_material.h"
#include "transport/path_tracer.h"
#include "transport/weights.h"

namespace stilb::estimators {

/// What gathering rays add to bounded connections with the surface (weights.h): 1 - w, for a part with
/// relative BRDF s.
struct PartShares {
    explicit PartShares(double g_over_k) : by_relative{g_over_k} {}

    double diffuse() const { return by_relative(1); }
    double of_gloss(double relative) const {
        return by_relative(transport::bounding_brdf(relative, transport::VertexChoice::by_kernel));
    }
    transport::GatheredShare by_relative;
};

/// The probability with which a ray that meets such a surface is continued: about the share of its reflected
/// light for which rays are responsible.
double continuation_probability(const materials::SplitMaterial& material, const PartShares& shares);

/// One sample of the luminance towards `outgoing`, without emission.
Rgb reflected_luminance(const transport::PathTracer& tracer, const rays::Hit& surface, const Vec3& outgoing,
                        const materials::SplitMaterial& material, const PartShares& shares,
                        math::SampleStream& stream);

}  // namespace stilb::estimators
