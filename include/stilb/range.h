// Ranges of numbers.
#pragma once

#include <string_view>

#pragma GCC visibility push(default)

namespace stilb {

/// The range of a number, and its description for messages: "2 is not allowed. Allowed: {allowed}".
struct Range {
    double min = 0, max = 0;
    std::string_view allowed;

    constexpr bool contains(double value) const { return value >= min && value <= max; }
};

}  // namespace stilb

#pragma GCC visibility pop
