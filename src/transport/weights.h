// Weights of multiple importance sampling, and Russian roulette.
//
// Bounded connections with compensation [Kollig, Keller 2004] (theory T.1b; the papers and the theory call a
// light path a chain, and this weight the kernel split): light from y to x is shared between connections of
// light vertices and gathering rays from x. With G = cos+ cos+ / d^2 and s = pi f_r / albedo (1 on diffuse
// surfaces, large in glossy lobes) at y, and likewise at the sub-point x of a luminance (1 for illuminance),
// connections have the MIS weight w = k / (k + s_y s_x G): their weighted kernel f_y f_x G w stays below
// k albedo_y albedo_x / pi^2 for all BRDFs. Rays from x compensate with the weight 1 - w.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rgb.h"
#include "materials/material.h"

namespace stilb::transport {

/// The factor s of a BRDF value of a material.
inline double relative_brdf(const Material& material, const Rgb& brdf_per_sr) {
    const double albedo = reflectance_bound(material).luminance();
    return albedo > 0 ? std::numbers::pi * brdf_per_sr.luminance() / albedo : 0;
}

/// How light vertices are chosen for connections to a receiver: by their flux alone, or also by the kernel
/// and the lobe of their reflection towards the receiver.
enum class VertexChoice { by_flux, by_kernel };

/// The factor s_y that bounds connections. Vertices that are chosen by their lobes contribute evenly,
/// whatever their BRDF towards the receiver is: only very large values need a bound.
inline double bounding_brdf(double relative, VertexChoice choice) {
    constexpr double share = 0.01;
    return choice == VertexChoice::by_flux || relative <= 1 ? relative : 1 + share * (relative - 1);
}

/// The weight 1 - w of gathering rays, for a surface seen under a given G / k.
struct GatheredShare {
    double g_over_k = INFINITY;  ///< infinity: everything is gathered

    double operator()(double relative) const {
        return std::isinf(g_over_k) ? 1 : g_over_k * relative / (1 + g_over_k * relative);
    }
};

// The balance heuristic of multiple importance sampling [Veach and Guibas 1995].

/// The weight of a sample drawn with the first density, against the other technique's density. Infinite: the
/// other technique cannot draw it.
inline double balance(double pdf, double other_pdf) { return std::isinf(pdf) ? 1 : pdf / (pdf + other_pdf); }

// Russian roulette, which ends random walks without bias.

/// Below 1, so that walks end on white surfaces and in glass, too.
inline constexpr double kMostSurvival = 0.999;
/// Walks on surfaces that reflect more than kMostSurvival, but less than this, survive as often as light
/// does: they end, after many steps. With kMostSurvival their throughput would grow, and from a reflectance
/// of 0.9995 on the variance would be infinite.
inline constexpr double kWhite = 0.99999;

/// The largest survival probability of a step with this factor, a double or, in loops over lanes, a float.
template <typename Number>
constexpr Number most_survival(Number factor) {
    constexpr auto most = static_cast<Number>(kMostSurvival), white = static_cast<Number>(kWhite);
    return factor < white ? std::max(factor, most) : most;
}

/// The survival probability of a walk before its throughput is multiplied by `factor`: it keeps the value of
/// the largest band.
constexpr double survival_probability(const Rgb& throughput, const Rgb& factor) {
    const double before = throughput.max();
    if (!(before > 0)) return 0;
    const double kept = (throughput * factor).max() / before;
    return std::min(kept, most_survival(kept));
}

/// The same for paths that gather light at every step, whose noise is less if they always survive while their
/// throughput is large: roulette begins where the largest band would fall below an eighth.
/// `largest`: that band, a double or, in loops over lanes, a float. `factor`: the largest of all bands.
template <typename Number>
constexpr Number patient_survival_probability(Number largest, Number factor) {
    constexpr Number roulette_threshold = 0.125;
    return std::min(largest / roulette_threshold, most_survival(factor));
}
constexpr double patient_survival_probability(const Rgb& throughput, const Rgb& factor) {
    return patient_survival_probability((throughput * factor).max(), factor.max());
}

}  // namespace stilb::transport
