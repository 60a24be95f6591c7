// Whether single contributions carry so much of a sum that its interval cannot be trusted.
#pragma once

#include <cmath>
#include <cstdint>

namespace stilb::statistics {

/// The share of a sum of `count` independent contributions that its largest one may have: 1/sqrt(count).
///
/// Where the contributions' variance is finite, the largest one's share times sqrt(count) falls to 0 as they
/// become more; where it is infinite (tails of index below 2, such as local estimation has in corners), it
/// grows without limit. At this share the largest contribution alone moves the sum by the standard error of
/// contributions that vary as much as their mean. A fixed share would miss slowly converging sums at large
/// counts and blame small counts for nothing.
inline double heavy_tail_share(std::uint64_t count) { return 1 / std::sqrt(static_cast<double>(count)); }

/// Whether the result deserves a warning. A sum of 0 does not; `count` counts the contributions that are 0
/// too.
inline bool is_heavy_tailed(double largest, double sum, std::uint64_t count) {
    return std::abs(largest) > heavy_tail_share(count) * std::abs(sum);
}

}  // namespace stilb::statistics
