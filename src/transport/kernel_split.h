// The kernel split (theory T.1b): which part of the light from y to x comes by chains, which by rays from x.
//
// With G = cos+ cos+ / d^2 and s = pi f_r / albedo (1 on diffuse surfaces, large in glossy lobes) at y, and
// likewise at the sub-point x where a luminance is measured (1 for illuminance), chains have the share
// w = k / (k + s_y s_x G): the kernel f_y f_x G w that they are weighted with stays below k albedo_y
// albedo_x / pi^2, whatever the BRDFs.
#pragma once

#include <cmath>
#include <numbers>

#include "materials/material.h"

namespace stilb::transport {

/// s for a BRDF value of a material.
inline double relative_brdf(const Material& material, const Rgb& brdf_per_sr) {
    const double albedo = reflectance_bound(material).luminance();
    return albedo > 0 ? std::numbers::pi * brdf_per_sr.luminance() / albedo : 0;
}

/// 1 - w for a surface seen under a given G / k.
struct GatheredShare {
    double g_over_k = INFINITY;  ///< infinity: everything is gathered

    double operator()(double relative) const {
        return std::isinf(g_over_k) ? 1 : g_over_k * relative / (1 + g_over_k * relative);
    }
};

}  // namespace stilb::transport
