// Comparisons that take minutes at the errors that are wanted are coarser in the suite of every commit.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace stilb {

/// The factor on errors that are aimed at and noticed; 1 where STILB_FINE is set, as in `make verify-long`.
/// Sanitizers slow the methods down some thirty times, and look for errors of memory and arithmetic rather
/// than for bias: with them everything is compared less finely.
inline double coarser(double factor = 1) {
#ifdef __SANITIZE_ADDRESS__
    return std::max(factor, 5.0);
#else
    return std::getenv("STILB_FINE") != nullptr ? 1 : factor;
#endif
}

/// The samples that give errors which are larger by coarser(factor) than those of `samples`.
inline std::uint64_t fewer(std::uint64_t samples, double factor = 1) {
    const double larger = coarser(factor);
    return std::max(static_cast<std::uint64_t>(static_cast<double>(samples) / (larger * larger)),
                    std::uint64_t{1});
}

}  // namespace stilb
