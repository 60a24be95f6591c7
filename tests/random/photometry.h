// The luminaire files of random scenes: intensities over angles, for the files and for exact values.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace stilb::random {

inline double cosine_of_deg(double angle_deg) { return std::max(0.0, std::cos(angle_deg * kPi / 180)); }

inline double cosine_cd(double gamma_deg, double) { return 100 * cosine_of_deg(gamma_deg); }
inline double beam_cd(double gamma_deg, double) { return 100 * std::pow(cosine_of_deg(gamma_deg), 3); }
/// A wall washer towards C90.
inline double washer_cd(double gamma_deg, double c_deg) {
    const double side = 1 + 0.9 * std::cos((c_deg - 90) * kPi / 180);
    return (50 * side * side * std::sin(gamma_deg * kPi / 180) + 20) * cosine_of_deg(gamma_deg);
}

/// Steps of the files' angles; between them, intensities are linear in both.
inline constexpr double kGammaStep_deg = 1, kPlaneStep_deg = 15;

/// As a file states it, at any angles (C from 0 to 360).
template <typename Intensity>
double between_steps_cd(const Intensity& intensity_cd, double gamma_deg, double c_deg) {
    const double g = std::floor(gamma_deg / kGammaStep_deg), u = gamma_deg / kGammaStep_deg - g;
    const double c = std::floor(c_deg / kPlaneStep_deg), v = c_deg / kPlaneStep_deg - c;
    const auto at = [&](double i, double j) {
        return i * kGammaStep_deg > 90 ? 0 : intensity_cd(i * kGammaStep_deg, j * kPlaneStep_deg);
    };
    return (1 - v) * ((1 - u) * at(g, c) + u * at(g + 1, c)) +
           v * ((1 - u) * at(g, c + 1) + u * at(g + 1, c + 1));
}

}  // namespace stilb::random
