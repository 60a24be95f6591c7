// Sanitizers slow the methods down some thirty times. They look for errors of memory and arithmetic rather
// than for bias, so with them everything is compared less finely.
#pragma once

namespace stilb {

#ifdef __SANITIZE_ADDRESS__
inline constexpr double kCoarser = 5;
#else
inline constexpr double kCoarser = 1;
#endif

}  // namespace stilb
