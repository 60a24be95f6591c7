// Sensors. One file a kind; a kind is a struct with
//
//     kType, kReadings                its name in files, the name of its readings
//     kQuantity, or quantity()        the quantity
//     fields()                        its keys in scene files (fields.h, base/field.h)
//     size(), measurand(j)            its readings, all of one quantity; cameras and derived values have none
//
// and optionally settle(given) for conditions between its keys, location(j) where results show more than
// location_of(measurand), common_location() and `count` for rows and columns. The scene reader, JSON, CSV,
// the table and `info` use this interface alone: a new kind is its files and a line in SensorKind.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "sensors/areas/area.h"
#include "sensors/bodies.h"
#include "sensors/camera.h"
#include "sensors/derived.h"
#include "sensors/glare.h"
#include "sensors/goniometer.h"
#include "sensors/illuminance.h"
#include "sensors/luminance.h"
#include "sensors/requirement.h"

namespace stilb::sensors {

using SensorKind = std::variant<IlluminancePoints, Grid, Area, Cylindrical, Semicylindrical, Hemispherical,
                                Spherical, Luminance, Goniometer, Ugr, Dgp, Derived, Camera>;

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
    std::vector<Requirement> requirements{};

    std::string_view type() const;
    Quantity quantity() const;
    bool measures_luminance() const { return !derived() && quantity().unit == kLuminance.unit; }
    /// Whether uniformity and diversity are defined, as those of an illuminated area are.
    bool has_ratios() const { return !measures_luminance() && !derived() && !rates_glare(); }
    /// Whether its readings are ratings of glare, which are made of illuminances after the run.
    bool rates_glare() const {
        return std::visit([]<typename Kind>(const Kind&) { return kRatesGlare<Kind>; }, kind);
    }
    /// Whether something can be required of it by this criterion: of ratings of glare by "ugr" alone.
    bool takes(const Criterion& criterion) const;

    /// Number of readings; a camera, which makes a picture, and a derived value have none.
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
    /// The derived value; null for other sensors.
    const Derived* derived() const { return std::get_if<Derived>(&kind); }
};

/// A derived value with its unit. Throws InputError, without the sensor's name, where its formula does not
/// fit the sensors: each of its operands is a reading or a statistic of one of them that is measured.
Derived resolved(const Derived& derived, std::span<const Sensor> sensors);
/// The sensor of this name; null where there is none.
const Sensor* find_sensor(std::span<const Sensor> sensors, std::string_view name);

/// The area of all horizontal areas that receive light from above, without bands; where they overlap, the
/// overlap counts twice.
double task_area_m2(std::span<const Sensor> sensors);

bool has_requirements(std::span<const Sensor> sensors);

/// Some of the points at which sensors measure, and cameras stand: of each the first, the last and some in
/// between.
std::vector<Vec3> measured_points(std::span<const Sensor> sensors);

// Choosing by name; `file` is where the sensors come from, for messages. All throw InputError.

/// The camera of that name; where the name is empty, the only one.
const Sensor& choose_camera(const std::vector<Sensor>& all, const std::string& name,
                            const std::string& file = "");
/// The sensors of these names, which must not be cameras, and those that derived values among them need;
/// where there are no names, all that are no cameras.
std::vector<Sensor> choose_meters(const std::vector<Sensor>& all, const std::vector<std::string>& names,
                                  const std::string& file = "");

}  // namespace stilb::sensors

namespace stilb {
using sensors::Sensor;
}  // namespace stilb
