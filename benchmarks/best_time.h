// How long something takes when nothing else gets in its way.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

namespace stilb {

/// The best of some runs [s].
template <typename Work>
double best_time_s(int repetitions, const Work& work) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repetitions; ++i) {
        const auto start = std::chrono::steady_clock::now();
        work();
        best =
            std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

}  // namespace stilb
