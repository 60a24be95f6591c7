// The statistics of a sensor's readings, as results, expressions and requirements name them.
#pragma once

#include <array>
#include <string_view>

namespace stilb {

/// Uniformity is the minimum over the mean (U0), diversity the minimum over the maximum (Ud).
enum class Statistic { mean, minimum, maximum, uniformity, diversity };
/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 5> kStatisticNames{"mean", "minimum", "maximum", "uniformity",
                                                                 "diversity"};

constexpr std::string_view name_of(Statistic statistic) {
    return kStatisticNames[static_cast<std::size_t>(statistic)];
}
/// Whether it is a ratio of two readings, which has no unit.
constexpr bool is_ratio(Statistic statistic) {
    return statistic == Statistic::uniformity || statistic == Statistic::diversity;
}

}  // namespace stilb
