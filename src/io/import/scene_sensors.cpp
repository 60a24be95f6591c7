// Sensors as tables of a scene file.
#include <fmt/format.h>

#include <array>
#include <concepts>
#include <utility>

#include "io/import/scene_parts.h"
#include "io/scene/toml_text.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

/// Writes the keys of a sensor, one kind of key after another.
template <typename Kind>
struct SensorTable {
    const Kind& kind;
    TomlMembers& members;

    void push(std::string_view key, TomlValue value) const {
        members.push_back({std::string(key), 0, std::move(value)});
    }

    /// A number, a vector or two counts.
    template <typename Plain>
    bool write(const Plain& field) const requires std::same_as<decltype(Plain::member), double Kind::*> ||
        std::same_as<decltype(Plain::member), Vec3 Kind::*> ||
        std::same_as<decltype(Plain::member), std::array<int, 2> Kind::*> {
        push(field.key, toml_value(kind.*field.member));
        return true;
    }
    bool write(const sensors::DirectionField<Kind, std::optional<Vec3>>& field) const {
        if (kind.*field.member) push(field.key, toml_vector(*(kind.*field.member)));
        return true;
    }
    bool write(const sensors::PositionsField<Kind>& field) const {
        push("positions", toml_value(kind.*field.member));
        return true;
    }
    bool write(const sensors::MeasuringPointsField<Kind>& field) const {
        const std::vector<MeasuringPoint>& points = kind.*field.member;
        std::vector<Vec3> positions;
        for (const MeasuringPoint& point : points) {
            if (!(point.normal == points.front().normal)) return false;
            positions.push_back(point.position);
        }
        push("positions", toml_value(positions));
        push("normal", toml_vector(points.front().normal));
        return true;
    }
    bool write(const sensors::ParallelogramField<Kind>& field) const {
        push("corner", toml_vector(kind.*field.corner));
        push("edge_u", toml_vector(kind.*field.edge_u));
        push("edge_v", toml_vector(kind.*field.edge_v));
        return true;
    }
    template <typename Enumeration>
    bool write(const sensors::ChoiceField<Kind, Enumeration>& field) const {
        push(field.key, toml_text(std::string(field.names[static_cast<std::size_t>(kind.*field.member)])));
        return true;
    }
    /// Formulas, polygons, faces of objects, lines of sight: no other format has them.
    template <typename Other>
    bool write(const Other&) const {
        return false;
    }
};

TomlMembers sensor_table(const Sensor& sensor) {
    TomlMembers members{{"type", 0, toml_text(std::string(sensor.type()))}};
    bool is_written = sensor.requirements.empty();
    std::visit(
        [&]<typename Kind>(const Kind& kind) {
            for_each_field<Kind>([&](const auto& field) {
                is_written = SensorTable<Kind>{kind, members}.write(field) && is_written;
            });
        },
        sensor.kind);
    if (!is_written) {
        throw InputError(
            fmt::format("sensor {} of type {} cannot be written by import. Add it to the scene file "
                        "that import writes.",
                        in_quotes(sensor.name), sensor.type()));
    }
    return members;
}

}  // namespace

TomlMembers sensor_tables(const std::vector<Sensor>& sensors) {
    TomlMembers tables;
    for (const Sensor& sensor : sensors) tables.push_back({sensor.name, 0, {sensor_table(sensor)}});
    return tables;
}

}  // namespace stilb::io
