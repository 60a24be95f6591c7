// Comparisons that take minutes at the errors that are wanted are coarser in the suite of every commit.
#pragma once

#include <cstdlib>

namespace stilb {

/// The factor on errors that are aimed at and noticed; 1 where STILB_FINE is set, as in `make verify-long`.
inline double coarser(double factor) { return std::getenv("STILB_FINE") != nullptr ? 1 : factor; }

}  // namespace stilb
