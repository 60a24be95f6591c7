// Luminance along single lines of sight.
#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "sensors/fields.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

struct Luminance {
    std::vector<Measurand> sights;  ///< of luminance; scene files have lines of sight only

    static constexpr std::string_view kType = "luminance";
    static constexpr Quantity kQuantity = kLuminance;
    static constexpr Noun kReadings{"line of sight", "lines of sight"};
    static constexpr auto fields() {
        return std::tuple{SightsField{&Luminance::sights, "position and viewing direction"}};
    }

    std::size_t size() const { return sights.size(); }
    Measurand measurand(std::size_t j) const { return sights[j]; }
};

}  // namespace stilb::sensors

namespace stilb {
using sensors::Luminance;
}  // namespace stilb
