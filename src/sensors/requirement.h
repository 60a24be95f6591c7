// What is required of a sensor's readings: "mean = 500" is a mean of at least 500.
#pragma once

#include <array>
#include <string_view>

#include "base/statistic.h"

namespace stilb::sensors {

enum class Limit { at_least, at_most };

constexpr std::string_view name_of(Limit limit) { return limit == Limit::at_least ? "at least" : "at most"; }

/// A key of `require`.
struct Criterion {
    std::string_view key;
    Statistic statistic;
    Limit limit;
};
inline constexpr std::array<Criterion, 6> kCriteria{{{"mean", Statistic::mean, Limit::at_least},
                                                     {"minimum", Statistic::minimum, Limit::at_least},
                                                     {"maximum", Statistic::maximum, Limit::at_most},
                                                     {"uniformity", Statistic::uniformity, Limit::at_least},
                                                     {"diversity", Statistic::diversity, Limit::at_least},
                                                     {"ugr", Statistic::maximum, Limit::at_most}}};

struct Requirement {
    const Criterion* criterion = nullptr;  ///< one of kCriteria
    double limit = 0;                      ///< in the sensor's unit; of ratios without a unit
};

}  // namespace stilb::sensors

namespace stilb {
using sensors::Requirement;
}  // namespace stilb
