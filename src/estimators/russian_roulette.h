// Ending random walks without bias.
#pragma once

#include <algorithm>

#include "base/spectrum.h"

namespace stilb {

/// With what probability a walk goes on whose throughput is about to be multiplied by `factor`: so that the
/// largest band keeps its value. Below 1 even on white surfaces, so that every walk ends.
constexpr double survival_probability(const Spectrum& throughput, const Spectrum& factor) {
    constexpr double most = 0.995;
    const double before = throughput.max();
    return before > 0 ? std::min((throughput * factor).max() / before, most) : 0;
}

}  // namespace stilb
