// Reads the parameters of a material or a sensor from the field list of its type.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/warning.h"
#include "io/scene/sections.h"
#include "io/scene/toml.h"
#include "materials/shares_by_angle.h"
#include "sensors/fields.h"
#include "sensors/sensor.h"

namespace stilb::sensors {
class RoomsOnDemand;
}  // namespace stilb::sensors

namespace stilb::io {

inline void read_value(const TomlItem& item, const Range& range, double& value) {
    value = item.number(range);
}
inline void read_value(const TomlItem& item, const Range& range, Rgb& value) { value = item.rgb(range); }
inline void read_value(const TomlItem& item, const Range&, bool& value) { value = item.boolean(); }
/// A number or a colour, or rows of an angle and one of these.
void read_value(const TomlItem& item, const Range& range, materials::SharesByAngle& value);
template <std::size_t count>
void read_value(const TomlItem& item, const Range& range, std::array<double, count>& values) {
    const std::vector<double> numbers = item.numbers(count, range);
    std::copy(numbers.begin(), numbers.end(), values.begin());
}

/// The keys of a type's parameters.
template <typename Parameters>
std::vector<std::string_view> keys_of() {
    std::vector<std::string_view> keys;
    for_each_field<Parameters>([&](const auto& field) { keys.push_back(field.key); });
    return keys;
}

/// The parameters that the table's keys give; throws where one is missing or wrong. Ignores keys
/// that are not parameters.
template <typename Parameters>
Parameters read_fields(const TomlTable& table) {
    Parameters parameters;
    for_each_field<Parameters>([&](const auto& field) {
        const bool is_required = field.presence == Presence::required;
        const auto item = is_required ? std::optional(table.at(field.key)) : table.find(field.key);
        if (item) read_value(*item, field.range, parameters.*field.member);
    });
    if (const auto message = contradiction_in(parameters)) table.fail(*message);
    return parameters;
}

// Reads a sensor by the list of its fields: one function for each kind of key of sensors/fields.h.

/// The context for reading a table; warnings are for values that are unusual but not wrong.
struct FieldSource {
    const TomlTable& table;
    std::vector<Warning>& warnings;
};

using Keys = std::vector<std::string_view>;

// The parts that do not depend on the type.

/// Reads the one of the keys "position", "points", "positions" and "array" that is given.
std::vector<Vec3> read_positions(const TomlTable& table);
std::vector<MeasuringPoint> read_measuring_points(const FieldSource& source);
std::vector<Measurand> read_sights(const FieldSource& source);
Expression read_formula(const TomlItem& item);
sensors::PolygonInSpace read_polygon(const TomlTable& table);
sensors::Surfaces read_surfaces(const TomlTable& table);
/// Makes the points of an area on faces of objects or of a room, which the scene has by now.
void place_on_surfaces(const TomlTable& table, sensors::RoomsOnDemand& building, Area& area);
sensors::Band read_band(const TomlItem& item);
/// The table "require" of a sensor, or of a band; empty where there is none.
std::vector<Requirement> read_requirements(const TomlTable& owner, const Sensor& sensor);
std::array<int, 2> read_counts(const TomlItem& item, const sensors::CountLimit& limit);
/// The unit vector from the position to a target.
Vec3 read_direction_to(const TomlItem& target, const Vec3& position);

// The keys of each kind of field, as messages list them.

template <typename Owner, typename Value>
Keys keys_of(const Field<Owner, Value>& field) {
    return {field.key};
}
template <typename Owner>
Keys keys_of(const sensors::PositionField<Owner>& field) {
    return {field.key};
}
template <typename Owner>
Keys keys_of(const sensors::TargetField<Owner>& field) {
    return {field.key};
}
template <typename Owner, typename Value>
Keys keys_of(const sensors::DirectionField<Owner, Value>& field) {
    return {field.key};
}
template <typename Owner>
Keys keys_of(const sensors::PositionsField<Owner>&) {
    return {"position", "points", "positions", "array"};
}
template <typename Owner>
Keys keys_of(const sensors::MeasuringPointsField<Owner>&) {
    return {"position", "points", "positions", "array", "normal"};
}
template <typename Owner>
Keys keys_of(const sensors::SightsField<Owner>&) {
    return {"position", "points", "positions", "array", "direction", "target", "directions", "targets"};
}
template <typename Owner>
Keys keys_of(const sensors::EyesField<Owner>&) {
    return {"position", "points", "positions", "array", "direction", "target", "directions", "targets"};
}
template <typename Owner>
Keys keys_of(const sensors::ParallelogramField<Owner>&) {
    return {"corner", "positions", "array", "edge_u", "edge_v"};
}
template <typename Owner>
Keys keys_of(const sensors::CountsField<Owner>& field) {
    return {field.key};
}
template <typename Owner, typename Enumeration>
Keys keys_of(const sensors::ChoiceField<Owner, Enumeration>& field) {
    return {field.key};
}
template <typename Owner>
Keys keys_of(const sensors::FormulaField<Owner>& field) {
    return {field.key};
}
template <typename Owner>
Keys keys_of(const sensors::PolygonField<Owner>&) {
    return {"corners", "height", "holes", "corner", "edge_u", "edge_v"};
}
template <typename Owner>
Keys keys_of(const sensors::SurfacesField<Owner>&) {
    return {"object", "room", "part"};
}
template <typename Owner>
Keys keys_of(const sensors::BandField<Owner>& field) {
    return {field.key};
}

// The member is set from the values of the keys.

inline bool is_left_out(const FieldSource& source, std::string_view key, Presence presence) {
    return presence == Presence::optional && !source.table.has(key);
}

template <typename Owner, typename Value>
void read_field(const Field<Owner, Value>& field, const FieldSource& source, Owner& owner) {
    if (is_left_out(source, field.key, field.presence)) return;
    owner.*field.member = source.table.at(field.key).number(field.range);
}
template <typename Owner>
void read_field(const sensors::PositionField<Owner>& field, const FieldSource& source, Owner& owner) {
    owner.*field.member = source.table.at(field.key).vector();
}
template <typename Owner>
void read_field(const sensors::TargetField<Owner>& field, const FieldSource& source, Owner& owner) {
    const TomlItem item = source.table.at(field.key);
    owner.*field.member = item.vector();
    read_direction_to(item, owner.*field.position);  // fails if both points coincide
}
template <typename Owner, typename Value>
void read_field(const sensors::DirectionField<Owner, Value>& field, const FieldSource& source, Owner& owner) {
    if (is_left_out(source, field.key, field.presence)) return;
    const TomlItem item = source.table.at(field.key);
    owner.*field.member = field.warns_of_length ? read_direction(item, source.warnings) : item.direction();
}
template <typename Owner>
void read_field(const sensors::PositionsField<Owner>& field, const FieldSource& source, Owner& owner) {
    owner.*field.member = read_positions(source.table);
}
template <typename Owner>
void read_field(const sensors::MeasuringPointsField<Owner>& field, const FieldSource& source, Owner& owner) {
    owner.*field.member = read_measuring_points(source);
}
template <typename Owner>
void read_field(const sensors::SightsField<Owner>& field, const FieldSource& source, Owner& owner) {
    owner.*field.member = read_sights(source);
}
template <typename Owner>
void read_field(const sensors::EyesField<Owner>& field, const FieldSource& source, Owner& owner) {
    for (const Measurand& sight : read_sights(source)) {
        const auto& [position, direction] = std::get<LineOfSight>(sight);
        (owner.*field.member).push_back({position, direction});
    }
}
template <typename Owner>
void read_field(const sensors::ParallelogramField<Owner>& field, const FieldSource& source, Owner& owner) {
    const Rectangle rectangle = read_rectangle(source.table);
    owner.*field.corner = rectangle.corner;
    owner.*field.edge_u = rectangle.edge_u;
    owner.*field.edge_v = rectangle.edge_v;
}
template <typename Owner>
void read_field(const sensors::CountsField<Owner>& field, const FieldSource& source, Owner& owner) {
    owner.*field.member = read_counts(source.table.at(field.key), field.limit);
}
template <typename Owner, typename Enumeration>
void read_field(const sensors::ChoiceField<Owner, Enumeration>& field, const FieldSource& source,
                Owner& owner) {
    if (is_left_out(source, field.key, field.presence)) return;
    owner.*field.member =
        static_cast<Enumeration>(source.table.at(field.key).index_in(field.names, field.key));
}

template <typename Owner>
void read_field(const sensors::FormulaField<Owner>& field, const FieldSource& source, Owner& owner) {
    owner.*field.member = read_formula(source.table.at(field.key));
}

template <typename Owner>
void read_field(const sensors::PolygonField<Owner>& field, const FieldSource& source, Owner& owner) {
    owner.*field.member = read_polygon(source.table);
}
template <typename Owner>
void read_field(const sensors::SurfacesField<Owner>& field, const FieldSource& source, Owner& owner) {
    owner.*field.member = read_surfaces(source.table);
}
template <typename Owner>
void read_field(const sensors::BandField<Owner>& field, const FieldSource& source, Owner& owner) {
    if (const auto item = source.table.find(field.key)) owner.*field.member = read_band(*item);
}

/// "type", and the keys of a kind of sensor.
template <typename Kind>
Keys sensor_keys() {
    Keys keys{"type"};
    for_each_field<Kind>([&](const auto& field) {
        for (const std::string_view key : keys_of(field)) keys.push_back(key);
    });
    if constexpr (!std::is_same_v<Kind, Camera> && !std::is_same_v<Kind, Dgp>) keys.push_back("require");
    return keys;
}

/// Reads a sensor of this kind, and checks its keys one by one and together.
template <typename Kind>
Kind read_by_fields(TomlTable& table, std::vector<Warning>& warnings) {
    table.expect_keys(sensor_keys<Kind>(), "type \"" + std::string(Kind::kType) + "\"");
    Kind kind;
    for_each_field<Kind>([&](const auto& field) { read_field(field, FieldSource{table, warnings}, kind); });
    if constexpr (requires(const sensors::GivenKeys& given) { kind.settle(given); }) {
        std::vector<std::string> given;
        for (const auto& [key, item] : table.items()) given.push_back(key);
        if (const auto fault = kind.settle(sensors::GivenKeys(std::move(given))))
            table.at(fault->key).fail(fault->message);
    }
    return kind;
}

}  // namespace stilb::io
