// Values that follow from those of other sensors.
#pragma once

#include <string>
#include <string_view>
#include <tuple>

#include "sensors/expression.h"
#include "sensors/fields.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

/// Nothing is measured for it: it has one value, and no measurands.
struct Derived {
    Expression formula;
    std::string unit{};  ///< from resolved() on; empty for a ratio

    static constexpr std::string_view kType = "derived";
    static constexpr Noun kReadings{"value", "values"};
    static constexpr auto fields() {
        return std::tuple{FormulaField{"value", &Derived::formula, "of other sensors"}};
    }

    Quantity quantity() const { return {"derived value", unit}; }
};

}  // namespace stilb::sensors

namespace stilb {
using sensors::Derived;
}  // namespace stilb
