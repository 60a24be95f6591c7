#include "sensors/derived.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sensors/sensor.h"
#include "stilb/error.h"

namespace stilb::sensors {
namespace {

/// The sensors that have readings.
std::vector<std::string_view> names_of_meters(std::span<const Sensor> sensors) {
    std::vector<std::string_view> names;
    for (const Sensor& sensor : sensors) {
        if (sensor.size() > 0) names.push_back(sensor.name);
    }
    return names;
}

/// The sensor that an operand is taken from.
const Sensor& meter_of(const Operand& operand, std::span<const Sensor> sensors) {
    const Sensor* sensor = find_sensor(sensors, operand.sensor);
    if (!sensor) {
        const std::vector<std::string_view> names = names_of_meters(sensors);
        throw InputError(fmt::format("there is no sensor \"{}\" to measure.{} Allowed: {}.", operand.sensor,
                                     did_you_mean(operand.sensor, names), fmt::join(names, ", ")));
    }
    if (sensor->derived()) {
        throw InputError(fmt::format("\"{}\" is itself a derived value. Write its formula here: {}.",
                                     sensor->name, sensor->derived()->formula.text()));
    }
    if (sensor->rates_glare()) {
        throw InputError(
            fmt::format("sensor \"{}\" rates glare, and ratings cannot be part of a formula.", sensor->name));
    }
    if (sensor->size() == 0)
        throw InputError(fmt::format("sensor \"{}\" is a camera, which has no readings.", sensor->name));
    return *sensor;
}

void require_reading(const Operand& operand, const Sensor& sensor) {
    const std::size_t readings = sensor.size();
    if (!operand.reading && readings > 1) {
        throw InputError(fmt::format(
            "sensor \"{}\" has {} readings. Write one of them, such as {}[0], or a statistic: {}.",
            sensor.name, readings, operand.sensor, fmt::join(kStatisticNames, ", ")));
    }
    if (operand.reading && *operand.reading >= readings) {
        throw InputError(fmt::format("{}: the readings of the sensor have the numbers 0 to {}.",
                                     text_of(operand), readings - 1));
    }
}

Dimension dimension_of(const Operand& operand, const Sensor& sensor) {
    if (!operand.statistic) require_reading(operand, sensor);
    if (!operand.statistic || !is_ratio(*operand.statistic))
        return std::map<std::string, int>{{std::string(sensor.quantity().unit), 1}};
    if (!sensor.has_ratios()) {
        throw InputError(fmt::format("{}: luminances have no {}. Allowed: mean, minimum, maximum.",
                                     text_of(operand), name_of(*operand.statistic)));
    }
    return std::map<std::string, int>{};
}

}  // namespace

const Sensor* find_sensor(std::span<const Sensor> sensors, std::string_view name) {
    const auto found = std::ranges::find(sensors, name, &Sensor::name);
    return found != sensors.end() ? &*found : nullptr;
}

Derived resolved(const Derived& derived, std::span<const Sensor> sensors) {
    std::vector<Dimension> dimensions;
    for (const Operand& operand : derived.formula.operands())
        dimensions.push_back(dimension_of(operand, meter_of(operand, sensors)));
    return {derived.formula, text_of(derived.formula.dimension(dimensions))};
}

}  // namespace stilb::sensors
