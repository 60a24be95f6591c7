// Discomfort glare at an eye: the Unified Glare Rating and the Daylight Glare Probability.
#pragma once

#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "sensors/fields.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

// Eyes with a direction of view each: the normal of a measuring point. What is measured is the illuminance
// at the eye; run/glare/glare.h makes the ratings of it.

/// A vertical line of sight has no upper side.
inline std::optional<Fault> fault_of_eyes(const std::vector<MeasuringPoint>& eyes, const GivenKeys& given) {
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

inline Location location_of_eye(const MeasuringPoint& eye) {
    return {"at", eye.position, {{"direction", "looking", eye.normal}}};
}

inline constexpr Noun kViews{"view", "views"};
inline constexpr std::string_view kEyesMeaning = "positions of the eye, and directions of view";

/// The Unified Glare Rating of electric lighting.
struct Ugr {
    std::vector<MeasuringPoint> eyes;

    static constexpr std::string_view kType = "ugr";
    static constexpr Quantity kQuantity{"UGR", ""};
    static constexpr Noun kReadings = kViews;
    static constexpr auto fields() { return std::tuple{EyesField{&Ugr::eyes, kEyesMeaning}}; }
    std::optional<Fault> settle(const GivenKeys& given) const { return fault_of_eyes(eyes, given); }

    std::size_t size() const { return eyes.size(); }
    Measurand measurand(std::size_t j) const { return eyes[j]; }
    Location location(std::size_t j) const { return location_of_eye(eyes[j]); }
};

/// The Daylight Glare Probability.
struct Dgp {
    std::vector<MeasuringPoint> eyes;
    std::optional<double>
        threshold_cd_m2{};  ///< of glare sources; by default a multiple of the mean luminance

    static constexpr std::string_view kType = "dgp";
    static constexpr Quantity kQuantity{"DGP", ""};
    static constexpr Noun kReadings = kViews;
    static constexpr auto fields() {
        return std::tuple{
            EyesField{&Dgp::eyes, kEyesMeaning},
            Field{"threshold", &Dgp::threshold_cd_m2, Range{1e-6, 1e15, "a luminance above 0"},
                  "luminance from which on a place is a source of glare [cd/m2]; by default five "
                  "times the mean of the view",
                  Presence::optional}};
    }
    std::optional<Fault> settle(const GivenKeys& given) const { return fault_of_eyes(eyes, given); }

    std::size_t size() const { return eyes.size(); }
    Measurand measurand(std::size_t j) const { return eyes[j]; }
    Location location(std::size_t j) const { return location_of_eye(eyes[j]); }
};

template <typename Kind>
inline constexpr bool kRatesGlare = std::is_same_v<Kind, Ugr> || std::is_same_v<Kind, Dgp>;

}  // namespace stilb::sensors

namespace stilb {
using sensors::Dgp;
using sensors::Ugr;
}  // namespace stilb
