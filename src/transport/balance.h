// The balance heuristic of multiple importance sampling [Veach and Guibas 1995].
#pragma once

#include <cmath>

namespace stilb::transport {

/// The weight of a sample that was drawn with the first density, beside one drawn with the other. Infinite:
/// the other can never draw it.
inline double balance(double pdf, double other_pdf) { return std::isinf(pdf) ? 1 : pdf / (pdf + other_pdf); }

}  // namespace stilb::transport
