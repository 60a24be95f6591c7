// [sensors.NAME]
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "io/scene/fields.h"
#include "io/scene/repetition.h"
#include "sensors/areas/rooms.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using Warnings = std::vector<Warning>;

std::vector<Vec3> read_directions(const TomlItem& list, Warnings& warnings) {
    std::vector<Vec3> directions;
    Warnings of_list;
    for (const TomlItem& item : read_list(list, "direction"))
        directions.push_back(read_direction(item, of_list));
    if (of_list.empty()) return directions;
    warnings.push_back(of_list.front());
    if (of_list.size() > 1)
        warnings.push_back(fmt::format("{}: likewise {} more.", list.where(), of_list.size() - 1));
    return directions;
}

template <typename Kind>
sensors::SensorKind read_kind(TomlTable& table, Warnings& warnings) {
    return read_by_fields<Kind>(table, warnings);
}

/// Reads a sensor of the type with this index in SensorKind.
template <typename... Kinds>
sensors::SensorKind read_nth(std::size_t n, TomlTable& table, Warnings& warnings,
                             std::type_identity<std::variant<Kinds...>>) {
    constexpr std::array readers{&read_kind<Kinds>...};
    return readers[n](table, warnings);
}

template <typename... Kinds>
std::vector<TypeKeys> keys_of_types(std::type_identity<std::variant<Kinds...>>) {
    return {{Kinds::kType, sensor_keys<Kinds>()}...};
}

/// The type of sensors that stand for areas, not one of SensorKind.
constexpr std::string_view kPlane = "plane";

sensors::SensorKind read_sensor(TomlTable& table, Warnings& warnings) {
    std::vector<std::string_view> types(sensors::kSensorTypeNames.begin(), sensors::kSensorTypeNames.end());
    types.push_back(kPlane);  // for messages
    const std::string_view type = table.choose("type", types);
    const auto found = std::ranges::find(sensors::kSensorTypeNames, type);
    return read_nth(static_cast<std::size_t>(found - sensors::kSensorTypeNames.begin()), table, warnings,
                    std::type_identity<sensors::SensorKind>{});
}

/// Illuminances, luminances and their ratios; derived values may be below 0.
constexpr Range kLimit{0, 1e15, "a number from 0 to 1e15"};
constexpr Range kLimitOfDerived{-1e15, 1e15, "a number from -1e15 to 1e15"};
constexpr Range kLimitOfRatio{0, 1, "a share from 0 to 1"};
constexpr Range kLimitOfRating{0, 100, "a rating from 0 to 100"};

const Range& range_of(const sensors::Criterion& criterion, const Sensor& sensor) {
    if (is_ratio(criterion.statistic)) return kLimitOfRatio;
    if (sensor.rates_glare()) return kLimitOfRating;
    return sensor.derived() ? kLimitOfDerived : kLimit;
}

/// Adds the bands around an area as sensors of their own, "task.surround" and "task.background". They end at
/// the walls of its room.
void add_bands(const TomlTable& table, const Sensor& sensor, sensors::RoomsOnDemand& building,
               std::vector<Sensor>& all, Warnings& warnings) {
    const auto* area = std::get_if<Area>(&sensor.kind);
    if (!area || (!area->surround && !area->background)) return;
    const sensors::Room* const room = room_of(building.rooms(), *area);
    double from_m = 0;
    const auto add = [&](const char* key, const std::optional<sensors::Band>& band) {
        if (!band) return;
        Area around{.polygon = area->polygon,
                    .normal = area->normal,
                    .spacing_m = area->spacing_m,
                    .band_m = {from_m, from_m + band->width_m}};
        if (const auto fault = around.settle(sensors::GivenKeys({}))) table.at(key).fail(fault->message);
        from_m += band->width_m;
        if (room) end_at_walls(*room, building.scene(), building.caster(), around);
        if (around.points.empty()) {
            warnings.push_back(
                fmt::format("{}: no place of the band lies in the room of the area, whose walls end it: it "
                            "is not measured, "
                            "and no requirement on it is rated.",
                            table.at(key).where()));
            return;
        }
        all.push_back({fmt::format("{}.{}", sensor.name, key), std::move(around), band->requirements});
    };
    add("surround", area->surround);
    add("background", area->background);
}

/// Two sensors of one name: a band or a part of a plane, and another sensor.
void require_different_names(const TomlTable& section, const std::vector<Sensor>& all) {
    for (const Sensor& sensor : all) {
        if (std::ranges::count(all, sensor.name, &Sensor::name) < 2) continue;
        section.at(sensor.name)
            .fail(
                "has the name of a band around an area, or of one of several planes, which are sensors, too. "
                "Allowed: another name.");
    }
}

/// Checks a derived value against all sensors, and gives it its unit.
void resolve(const TomlTable& table, const std::string& name, std::vector<Sensor>& all) {
    const auto sensor = std::ranges::find(all, name, &Sensor::name);
    auto* const derived = sensor != all.end() ? std::get_if<Derived>(&sensor->kind) : nullptr;
    if (!derived) return;  // planes have other names where they are several
    try {
        *derived = sensors::resolved(*derived, all);
    } catch (const InputError& error) {
        table.at("value").fail(error.what());
    }
}

}  // namespace

std::vector<Vec3> read_positions(const TomlTable& table) {
    const TomlTable::NamedItem given = table.one_of({"position", "points", "positions", "array"});
    if (given.key == "position") return {given.item.vector()};
    return read_several_positions(given);
}

std::vector<MeasuringPoint> read_measuring_points(const FieldSource& source) {
    std::vector<MeasuringPoint> points;
    const std::vector<Vec3> positions = read_positions(source.table);
    const Vec3 normal = read_direction(source.table.at("normal"), source.warnings);
    for (const Vec3& position : positions) points.push_back({position, normal});
    return points;
}

std::array<int, 2> read_counts(const TomlItem& item, const sensors::CountLimit& limit) {
    const std::vector<TomlItem> counts = item.elements();
    if (counts.size() != 2)
        item.fail(fmt::format("found an array of {} where {} is needed.", counts.size(), limit.form));
    const std::int64_t a = counts[0].integer(1, limit.most_each), b = counts[1].integer(1, limit.most_each);
    if (a * b > limit.most) {
        item.fail(
            fmt::format("asks for {} {}. Allowed: {} {}.", a * b, limit.things, limit.most, limit.where));
    }
    return {static_cast<int>(a), static_cast<int>(b)};
}

Vec3 read_direction_to(const TomlItem& target, const Vec3& position) {
    const Vec3 offset = target.vector() - position;
    constexpr double shortest_m = 1e-9;
    if (length(offset) < shortest_m)
        target.fail("equals the position, so there is no direction to it. Allowed: any other point.");
    return normalized(offset);
}

namespace {

/// The directions from a position; those of `direction` and `directions` are the same from everywhere.
std::vector<Vec3> directions_from(const Vec3& position, const TomlTable::NamedItem& given,
                                  Warnings& warnings) {
    const auto& [key, item] = given;
    if (key == "direction") return {read_direction(item, warnings)};
    if (key == "directions") return read_directions(item, warnings);
    if (key == "target") return {read_direction_to(item, position)};
    std::vector<Vec3> directions;
    for (const TomlItem& target : read_list(item, "target"))
        directions.push_back(read_direction_to(target, position));
    return directions;
}

}  // namespace

std::vector<Measurand> read_sights(const FieldSource& source) {
    const std::vector<Vec3> positions = read_positions(source.table);
    const auto given = source.table.one_of({"direction", "target", "directions", "targets"});
    std::vector<Measurand> sights;
    for (const Vec3& position : positions) {
        for (const Vec3& direction : directions_from(position, given, source.warnings))
            sights.emplace_back(LineOfSight{position, direction});
    }
    return sights;
}

Expression read_formula(const TomlItem& item) {
    try {
        return Expression(item.text());
    } catch (const InputError& error) {
        item.fail(error.what());
    }
}

std::vector<Requirement> read_requirements(const TomlTable& owner, const Sensor& sensor) {
    std::vector<Requirement> requirements;
    const auto item = owner.find("require");
    if (!item) return requirements;
    TomlTable table = item->table();
    Keys keys;
    for (const sensors::Criterion& criterion : sensors::kCriteria) {
        if (!sensor.takes(criterion)) continue;
        keys.push_back(criterion.key);
        if (const auto limit = table.find(criterion.key))
            requirements.push_back({&criterion, limit->number(range_of(criterion, sensor))});
    }
    table.expect_keys(keys, fmt::format("type \"{}\"", sensor.type()));
    if (requirements.empty())
        item->fail(fmt::format("is empty. Allowed: {}, or no require.", fmt::join(keys, ", ")));
    return requirements;
}

std::vector<TypeKeys> sensor_types() {
    std::vector<TypeKeys> types = keys_of_types(std::type_identity<sensors::SensorKind>{});
    types.push_back({kPlane, plane_keys()});
    return types;
}

void read_sensors(const TomlTable& section, const Defaults& defaults, SceneFile& file) {
    // Grids are copied, as each is an area of its own. Other sensors have all positions together.
    const auto place = [](const TomlTable& table) -> std::string_view {
        return table.text_of("type") == Grid::kType ? "corner" : "";
    };
    std::int64_t readings = 0;
    sensors::RoomsOnDemand building(file.scene);
    const auto tables = repeated_tables(named_tables(section, defaults), place);
    for (auto [name, table, copy_of] : tables) {
        Warnings warnings;
        const std::size_t own = file.sensors.size();
        if (table.text_of("type") == kPlane) {
            std::ranges::move(read_planes(name, table, file.scene), std::back_inserter(file.sensors));
        } else {
            Sensor& sensor = file.sensors.emplace_back(Sensor{name, read_sensor(table, warnings)});
            if (auto* area = std::get_if<Area>(&sensor.kind); area && area->surfaces.are_given())
                place_on_surfaces(table, building, *area);
            sensor.requirements = read_requirements(table, sensor);
            add_bands(table, Sensor(sensor), building, file.sensors, warnings);
        }
        for (Warning& warning : warnings) {
            const bool is_new = std::ranges::find(file.warnings, warning) == file.warnings.end();
            if (is_new) file.warnings.push_back(std::move(warning));  // several positions have the same
        }
        for (std::size_t s = own; s < file.sensors.size(); ++s)
            readings += static_cast<std::int64_t>(file.sensors[s].size());
        if (readings > sensors::kMostReadings) {
            table.fail(fmt::format("the sensors up to this one have {} readings. Allowed: {} in all.",
                                   readings, sensors::kMostReadings));
        }
    }
    require_different_names(section, file.sensors);
    for (const auto& [name, table, copy_of] : tables) resolve(table, name, file.sensors);
}

}  // namespace stilb::io
