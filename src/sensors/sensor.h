// Sensors. One file a kind; a kind is a struct with
//
//     kType, kQuantity, kReadings     its name in files, the quantity, the name of its readings
//     fields()                        its keys in scene files (fields.h, base/field.h)
//     size(), measurand(j)            its readings, all of one quantity; cameras have none
//
// and optionally settle(given) for conditions between its keys, location(j) where results show more than
// location_of(measurand), common_location() and `count` for rows and columns. The scene reader, JSON, CSV,
// the table and `info` use this interface alone: a new kind is its files and a line in SensorKind.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "sensors/bodies.h"
#include "sensors/camera.h"
#include "sensors/goniometer.h"
#include "sensors/illuminance.h"
#include "sensors/luminance.h"

namespace stilb::sensors {

using SensorKind = std::variant<IlluminancePoints, Grid, Cylindrical, Semicylindrical, Hemispherical,
                                Spherical, Luminance, Goniometer, Camera>;

template <typename... Kinds>
constexpr std::array<std::string_view, sizeof...(Kinds)> type_names(
    std::type_identity<std::variant<Kinds...>>) {
    return {Kinds::kType...};
}
/// The names in scene files, in the order of SensorKind.
inline constexpr auto kSensorTypeNames = type_names(std::type_identity<SensorKind>{});

/// The name of the readings of a type of sensor.
Noun readings_of_type(std::string_view type);

struct Sensor {
    std::string name;
    SensorKind kind;

    std::string_view type() const;
    Quantity quantity() const;
    bool measures_luminance() const { return quantity().unit == kLuminance.unit; }

    /// Number of readings; a camera, which makes a picture, has none.
    std::size_t size() const;
    Measurand measurand(std::size_t j) const;
    /// All measurands, in order.
    std::vector<Measurand> measurands() const;
    Location location(std::size_t j) const;
    /// The common part of the locations of all readings, if results state it once.
    std::optional<Location> common_location() const;
    /// Columns and rows of readings that cover an area, u fastest.
    std::optional<std::array<int, 2>> count() const;
    /// The camera; null for other sensors.
    const Camera* camera() const { return std::get_if<Camera>(&kind); }
};

// Choosing by name; `file` is where the sensors come from, for messages. All throw InputError.

/// The camera of that name; where the name is empty, the only one.
const Sensor& choose_camera(const std::vector<Sensor>& all, const std::string& name,
                            const std::string& file = "");
/// The sensors of these names, which must not be cameras; where there are no names, all that are none.
std::vector<Sensor> choose_meters(const std::vector<Sensor>& all, const std::vector<std::string>& names,
                                  const std::string& file = "");

}  // namespace stilb::sensors

namespace stilb {
using sensors::Sensor;
}  // namespace stilb
