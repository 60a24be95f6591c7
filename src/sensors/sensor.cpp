#include "sensors/sensor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <stdexcept>

#include "stilb/error.h"

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
    return std::visit(
        []<typename Kind>(const Kind& one) {
            if constexpr (requires { one.quantity(); }) {
                return one.quantity();
            } else {
                return Kind::kQuantity;
            }
        },
        kind);
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

bool Sensor::takes(const Criterion& criterion) const {
    const bool rates_ugr = std::holds_alternative<Ugr>(kind), limits_ugr = criterion.key == Ugr::kType;
    if (rates_glare() || limits_ugr) return rates_ugr && limits_ugr;
    return has_ratios() || !is_ratio(criterion.statistic);
}

double task_area_m2(std::span<const Sensor> sensors) {
    constexpr double horizontal = 0.999;
    double all_m2 = 0;
    for (const Sensor& sensor : sensors) {
        const auto* area = std::get_if<Area>(&sensor.kind);
        const bool is_task = area && !area->surfaces.are_given() && area->band_m[1] == 0 &&
                             !area->points.empty() && area->points.front().normal.z > horizontal;
        if (is_task) all_m2 += area_m2(area->polygon);
    }
    return all_m2;
}

std::vector<Vec3> measured_points(std::span<const Sensor> sensors) {
    constexpr std::size_t most = 8;
    std::vector<Vec3> points;
    for (const Sensor& sensor : sensors) {
        if (const Camera* camera = sensor.camera()) points.push_back(camera->position);
        const std::size_t size = sensor.size(), count = std::min(size, most);
        for (std::size_t i = 0; i < count; ++i)
            points.push_back(position_of(sensor.measurand(count == 1 ? 0 : i * (size - 1) / (count - 1))));
    }
    return points;
}

bool has_requirements(std::span<const Sensor> sensors) {
    return !std::ranges::all_of(sensors, [](const Sensor& sensor) { return sensor.requirements.empty(); });
}

namespace {

/// The sensor of this name among those that `is_wanted`. `what`: their name in messages.
template <typename IsWanted>
const Sensor& sensor_named(const std::vector<Sensor>& all, const std::string& name, std::string_view what,
                           const std::string& file, const IsWanted& is_wanted) {
    std::vector<std::string_view> names;
    for (const Sensor& sensor : all) {
        if (!is_wanted(sensor)) continue;
        if (sensor.name == name) return sensor;
        names.push_back(sensor.name);
    }
    throw InputError(fmt::format("there is no {0} \"{1}\".{2} Allowed: {3}.", what, name,
                                 did_you_mean(name, names), fmt::join(names, ", ")),
                     {file});
}

bool is_camera(const Sensor& sensor) { return sensor.camera() != nullptr; }

/// Adds the sensors that derived values among the chosen ones need.
void add_operands(const std::vector<Sensor>& all, std::vector<Sensor>& chosen) {
    std::vector<Sensor> needed;
    for (const Sensor& sensor : chosen) {
        if (!sensor.derived()) continue;
        for (const Operand& operand : sensor.derived()->formula.operands()) {
            const Sensor* other = find_sensor(all, operand.sensor);
            if (other && !find_sensor(chosen, other->name) && !find_sensor(needed, other->name))
                needed.push_back(*other);
        }
    }
    std::ranges::move(needed, std::back_inserter(chosen));
}

}  // namespace

const Sensor& choose_camera(const std::vector<Sensor>& all, const std::string& name,
                            const std::string& file) {
    std::vector<std::string_view> cameras;
    for (const Sensor& sensor : all) {
        if (is_camera(sensor)) cameras.push_back(sensor.name);
    }
    if (cameras.empty()) {
        throw InputError("no camera: the scene needs a sensor of type \"camera\" under [sensors].", {file});
    }
    if (name.empty() && cameras.size() > 1) {
        throw InputError(fmt::format("the scene has several cameras: {}. Name one of them as the sensor.",
                                     fmt::join(cameras, ", ")),
                         {file});
    }
    return sensor_named(all, name.empty() ? std::string(cameras.front()) : name, "camera", file, is_camera);
}

std::vector<Sensor> choose_meters(const std::vector<Sensor>& all, const std::vector<std::string>& names,
                                  const std::string& file) {
    std::vector<Sensor> chosen;
    for (const std::string& name : names) {
        if (std::ranges::any_of(all, [&](const Sensor& s) { return s.name == name && is_camera(s); })) {
            throw InputError(
                fmt::format("sensor \"{}\" is a camera, which makes a picture: render it.", name), {file});
        }
        chosen.push_back(sensor_named(all, name, "sensor", file, std::not_fn(is_camera)));
    }
    add_operands(all, chosen);
    if (names.empty()) std::ranges::remove_copy_if(all, std::back_inserter(chosen), is_camera);
    if (chosen.empty() && !all.empty()) {
        throw InputError(
            "no sensor to measure: all are cameras, which make pictures. Render one, or add another sensor.",
            {file});
    }
    return chosen;
}

}  // namespace stilb::sensors
