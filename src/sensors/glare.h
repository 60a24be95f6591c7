// Discomfort glare of electric lighting: the Unified Glare Rating at an eye.
#pragma once

#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "sensors/fields.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

/// Eyes with a direction of view each. What is measured is the vertical illuminance at the eye, of which the
/// background luminance is made; run/glare.h makes the ratings of it.
struct Ugr {
    std::vector<MeasuringPoint> eyes;  ///< the normal is the direction of view

    static constexpr std::string_view kType = "ugr";
    static constexpr Quantity kQuantity = kUgr;
    static constexpr Noun kReadings{"view", "views"};
    static constexpr auto fields() {
        return std::tuple{EyesField{&Ugr::eyes, "positions of the eye, and directions of view"}};
    }

    /// A vertical line of sight has no upper side.
    std::optional<Fault> settle(const GivenKeys& given) const {
        constexpr double least_sine = 1e-3;
        for (const MeasuringPoint& eye : eyes) {
            if (std::hypot(eye.normal.x, eye.normal.y) > least_sine) continue;
            for (const std::string_view key : {"direction", "target", "directions", "targets"}) {
                if (given.has(key))
                    return Fault{key, "a vertical direction of view has no rating. Allowed: any other."};
            }
        }
        return std::nullopt;
    }

    std::size_t size() const { return eyes.size(); }
    Measurand measurand(std::size_t j) const { return eyes[j]; }
    Location location(std::size_t j) const {
        return {"at", eyes[j].position, {{"direction", "looking", eyes[j].normal}}};
    }
};

}  // namespace stilb::sensors

namespace stilb {
using sensors::Ugr;
}  // namespace stilb
