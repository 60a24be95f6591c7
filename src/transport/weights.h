// The kernel split (theory T.1b): which part of the light from y to x comes by chains, which by rays from x.
//
// With G = cos+ cos+ / d^2 and s = pi f_r / albedo (1 on diffuse surfaces, large in glossy lobes) at y, and
// likewise at the sub-point x where a luminance is measured (1 for illuminance), chains have the share
// w = k / (k + s_y s_x G): the kernel f_y f_x G w that they are weighted with stays below k albedo_y
// albedo_x / pi^2, whatever the BRDFs.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rgb.h"
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

// The balance heuristic of multiple importance sampling [Veach and Guibas 1995].

/// The weight of a sample that was drawn with the first density, beside one drawn with the other. Infinite:
/// the other can never draw it.
inline double balance(double pdf, double other_pdf) { return std::isinf(pdf) ? 1 : pdf / (pdf + other_pdf); }

// Ending random walks without bias.

/// With what probability a walk goes on whose throughput is about to be multiplied by `factor`: so that the
/// largest band keeps its value. Below 1 even on white surfaces, so that every walk ends.
constexpr double survival_probability(const Rgb& throughput, const Rgb& factor) {
    constexpr double most = 0.995;
    const double before = throughput.max();
    return before > 0 ? std::min((throughput * factor).max() / before, most) : 0;
}

/// The same for paths that gather light at every step, whose noise is less where they go on for sure as long
/// as they matter: roulette begins where the largest band would fall below a quarter.
constexpr double patient_survival_probability(const Rgb& throughput, const Rgb& factor) {
    constexpr double light_path = 0.25, most = 0.995;
    return std::min((throughput * factor).max() / light_path, most);
}

}  // namespace stilb::transport
