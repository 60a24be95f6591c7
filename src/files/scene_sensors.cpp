// [sensors.NAME]
#include <fmt/format.h>

#include <array>

#include "files/scene_sections.h"

namespace stilb {
namespace {

constexpr std::array<std::string_view, 2> kTypes{"illuminance", "grid"};
constexpr std::array<std::string_view, 3> kLaterTypes{"luminance", "goniometer", "camera"};
/// Of all sensors together: 10 million readings take about half a gigabyte.
constexpr std::int64_t kMostPoints = 10'000'000;

std::vector<Vec3> read_positions(const TomlTable& table) {
    const TomlItem item = table.either("position", "points");
    if (table.has("position")) return {item.vector()};
    std::vector<Vec3> positions;
    for (const TomlItem& point : item.elements()) positions.push_back(point.vector());
    if (positions.empty()) item.fail("found no point. Allowed: [[x, y, z], ...] with one point or more.");
    return positions;
}

Sensor read_illuminance(TomlTable& table, std::vector<std::string>& warnings) {
    table.expect_keys({"type", "position", "points", "normal"}, "type \"illuminance\"");
    Sensor sensor;
    const std::vector<Vec3> positions = read_positions(table);
    const Vec3 normal = read_normal(table.at("normal"), warnings);
    for (const Vec3& position : positions) sensor.measurands.push_back(MeasuringPoint{position, normal});
    return sensor;
}

std::array<int, 2> read_count(const TomlItem& item) {
    const std::vector<TomlItem> counts = item.elements();
    if (counts.size() != 2)
        item.fail(fmt::format("found an array of {} where [nu, nv] is needed.", counts.size()));
    const std::int64_t u = counts[0].integer(1, kMostPoints), v = counts[1].integer(1, kMostPoints);
    if (u * v > kMostPoints) {
        item.fail(
            fmt::format("asks for {} points. Allowed: {} in all sensors together.", u * v, kMostPoints));
    }
    return {static_cast<int>(u), static_cast<int>(v)};
}

Sensor read_grid(TomlTable& table, std::vector<std::string>& warnings) {
    table.expect_keys({"type", "corner", "edge_u", "edge_v", "count", "normal"}, "type \"grid\"");
    const Rectangle r = read_rectangle(table);
    const Grid grid{r.corner, r.edge_u, r.edge_v, read_count(table.at("count"))};
    const auto normal = table.find("normal");
    return make_grid_sensor("", grid,
                            normal ? read_normal(*normal, warnings) : normalized(cross(r.edge_u, r.edge_v)));
}

}  // namespace

void read_sensors(const TomlTable& section, SceneFile& file) {
    std::int64_t points = 0;
    for (auto& [name, table] : named_tables(section)) {
        const std::string_view type = table.choose("type", kTypes, kLaterTypes);
        Sensor sensor =
            type == "grid" ? read_grid(table, file.warnings) : read_illuminance(table, file.warnings);
        sensor.name = name;
        points += static_cast<std::int64_t>(sensor.measurands.size());
        if (points > kMostPoints) {
            table.fail(
                fmt::format("the sensors so far have {} points. Allowed: {} in all.", points, kMostPoints));
        }
        file.sensors.push_back(std::move(sensor));
    }
}

}  // namespace stilb
