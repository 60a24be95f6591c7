#include "sensors/sensor.h"

#include <algorithm>
#include <stdexcept>

namespace stilb::sensors {
namespace {

template <typename Kind>
concept HasReadings = requires(const Kind& kind) {
    kind.measurand(std::size_t{});
};

template <typename... Kinds>
constexpr std::array<Noun, sizeof...(Kinds)> nouns(std::type_identity<std::variant<Kinds...>>) {
    return {Kinds::kReadings...};
}

}  // namespace

Noun readings_of_type(std::string_view type) {
    constexpr auto all = nouns(std::type_identity<SensorKind>{});
    const auto found = std::find(kSensorTypeNames.begin(), kSensorTypeNames.end(), type);
    return found != kSensorTypeNames.end() ? all[static_cast<std::size_t>(found - kSensorTypeNames.begin())]
                                           : kPoints;
}

std::string_view Sensor::type() const {
    return std::visit([]<typename Kind>(const Kind&) { return Kind::kType; }, kind);
}

Quantity Sensor::quantity() const {
    return std::visit([]<typename Kind>(const Kind&) { return Kind::kQuantity; }, kind);
}

std::size_t Sensor::size() const {
    return std::visit(
        []<typename Kind>(const Kind& one) -> std::size_t {
            if constexpr (HasReadings<Kind>) return one.size();
            return 0;
        },
        kind);
}

Measurand Sensor::measurand(std::size_t j) const {
    return std::visit(
        [j]<typename Kind>(const Kind& one) -> Measurand {
            if constexpr (HasReadings<Kind>) return one.measurand(j);
            throw std::logic_error("a sensor without readings has no measurand");
        },
        kind);
}

std::vector<Measurand> Sensor::measurands() const {
    std::vector<Measurand> all;
    const std::size_t count = size();
    all.reserve(count);
    for (std::size_t j = 0; j < count; ++j) all.push_back(measurand(j));
    return all;
}

Location Sensor::location(std::size_t j) const {
    return std::visit(
        [this, j]<typename Kind>(const Kind& one) {
            if constexpr (requires { one.location(j); }) {
                return one.location(j);
            } else {
                return location_of(measurand(j));
            }
        },
        kind);
}

std::optional<Location> Sensor::common_location() const {
    return std::visit(
        []<typename Kind>(const Kind& one) -> std::optional<Location> {
            if constexpr (requires { one.common_location(); }) return one.common_location();
            return std::nullopt;
        },
        kind);
}

std::optional<std::array<int, 2>> Sensor::count() const {
    return std::visit(
        []<typename Kind>(const Kind& one) -> std::optional<std::array<int, 2>> {
            if constexpr (requires { one.count; }) return one.count;
            return std::nullopt;
        },
        kind);
}

}  // namespace stilb::sensors
