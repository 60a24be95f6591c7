// Ending random walks without bias.
#pragma once

#include <algorithm>

#include "base/rgb.h"

namespace stilb::transport {

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
