// [sensors.NAME]
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/scene/sections.h"
#include "sensors/goniometer.h"

namespace stilb::io {
namespace {

/// Of all sensors together: 10 million measurands take 0.8 gigabytes.
constexpr std::int64_t kMostReadings = 10'000'000;
/// Of a picture; files of larger ones could not be read back.
constexpr std::int64_t kLongestSide = 100'000, kMostPixels = 64'000'000;
constexpr Range kStep{0.001, 90, "an angle above 0 (from 0.001 to 90 degrees)"};

using Warnings = std::vector<std::string>;

/// The elements of a list of triples, each a `what`.
std::vector<TomlItem> read_list(const TomlItem& list, std::string_view what) {
    std::vector<TomlItem> items = list.elements();
    if (items.empty()) {
        list.fail(fmt::format("found no {}. Allowed: [[x, y, z], ...] with one {} or more.", what, what));
    }
    return items;
}

Sensor read_illuminance(TomlTable& table, Warnings& warnings) {
    table.expect_keys({"type", "position", "points", "normal"}, "type \"illuminance\"");
    const auto [key, item] = table.one_of({"position", "points"});
    const Vec3 normal = read_direction(table.at("normal"), warnings);
    Sensor sensor;
    for (const TomlItem& point : key == "points" ? read_list(item, "point") : std::vector{item})
        sensor.measurands.push_back(MeasuringPoint{point.vector(), normal});
    return sensor;
}

/// How many there may be of what a pair of counts makes.
struct CountLimit {
    std::string_view form;
    std::int64_t most_each, most;
    std::string_view things, where;
};
constexpr CountLimit kGridLimit{"[nu, nv]", kMostReadings, kMostReadings, "points",
                                "in all sensors together"};
constexpr CountLimit kPictureLimit{"[width, height]", kLongestSide, kMostPixels, "pixels", "in a picture"};

std::array<int, 2> read_counts(const TomlItem& item, const CountLimit& limit) {
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

Sensor read_grid(TomlTable& table, Warnings& warnings) {
    table.expect_keys({"type", "corner", "edge_u", "edge_v", "count", "normal"}, "type \"grid\"");
    const Rectangle r = read_rectangle(table);
    const Grid grid{r.corner, r.edge_u, r.edge_v, read_counts(table.at("count"), kGridLimit)};
    const auto normal = table.find("normal");
    return make_grid_sensor(
        "", grid, normal ? read_direction(*normal, warnings) : normalized(cross(r.edge_u, r.edge_v)));
}

/// The unit vector from the position to a target.
Vec3 read_way_to(const TomlItem& target, const Vec3& position) {
    const Vec3 way = target.vector() - position;
    constexpr double shortest_m = 1e-9;
    if (length(way) < shortest_m)
        target.fail("lies at the position, so that there is no direction to it. Allowed: any other point.");
    return normalized(way);
}

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

Sensor read_luminance(TomlTable& table, Warnings& warnings) {
    table.expect_keys({"type", "position", "direction", "target", "directions", "targets"},
                      "type \"luminance\"");
    const Vec3 position = table.at("position").vector();
    const auto [key, item] = table.one_of({"direction", "target", "directions", "targets"});
    std::vector<Vec3> directions;
    if (key == "direction") directions = {read_direction(item, warnings)};
    if (key == "directions") directions = read_directions(item, warnings);
    if (key == "target") directions = {read_way_to(item, position)};
    if (key == "targets") {
        for (const TomlItem& target : read_list(item, "target"))
            directions.push_back(read_way_to(target, position));
    }
    Sensor sensor;
    for (const Vec3& direction : directions) sensor.measurands.push_back(LineOfSight{position, direction});
    return sensor;
}

Sensor read_goniometer(TomlTable& table, Warnings& warnings) {
    table.expect_keys({"type", "point", "normal", "plane", "step"}, "type \"goniometer\"");
    const TomlItem step = table.at("step");
    Goniometer goniometer{
        table.at("point").vector(), read_direction(table.at("normal"), warnings), {}, step.number(kStep)};
    if (const auto plane = table.find("plane")) goniometer.plane_deg = plane->number(kAngle);
    const std::int64_t count = direction_count(goniometer);
    if (count > kMostReadings) {
        step.fail(fmt::format("asks for {} directions. Allowed: {} readings in all sensors together.", count,
                              kMostReadings));
    }
    return make_goniometer_sensor("", goniometer);
}

struct FieldOfView {
    Range range;
    double default_deg;
};

FieldOfView field_of_view(Projection projection) {
    switch (projection) {
        case Projection::perspective:
            return {{0.001, 179.9, "an angle above 0 and below 180 degrees (from 0.001 to 179.9)"}, 60};
        case Projection::fisheye:
            return {{0.001, 360, "an angle above 0 (from 0.001 to 360 degrees)"}, 180};
        case Projection::panorama:
            return {{0.001, 360, "an angle above 0 (from 0.001 to 360 degrees)"}, 360};
    }
    return {};
}

void expect_upright(const TomlTable& table, const Camera& camera, const Vec3& unit_up) {
    constexpr double least = 1e-6;  // sine of the angle between up and the view
    if (length(cross(normalized(camera.target - camera.position), unit_up)) >= least) return;
    const std::string_view message =
        "is parallel to the way from position to target, so that no side of the picture is up. Allowed: any "
        "other direction.";
    if (const auto up = table.find("up")) up->fail(message);
    table.at("target").fail(
        "lies straight above or below the position, so that no side of the picture is up. Allowed: any other "
        "point, or another \"up\" than [0, 0, 1].");
}

Sensor read_camera(TomlTable& table) {
    table.expect_keys({"type", "position", "target", "up", "fov", "resolution", "projection", "filter"},
                      "type \"camera\"");
    Sensor sensor;
    Camera& camera = sensor.camera;
    camera.position = table.at("position").vector();
    camera.target = table.at("target").vector();
    read_way_to(table.at("target"), camera.position);
    if (const auto up = table.find("up")) camera.up = up->direction();
    expect_upright(table, camera, camera.up);
    camera.resolution = read_counts(table.at("resolution"), kPictureLimit);
    if (const auto projection = table.find("projection"))
        camera.projection =
            static_cast<Projection>(projection->index_in(sensors::kProjectionNames, "projection"));
    const FieldOfView view = field_of_view(camera.projection);
    const auto fov = table.find("fov");
    camera.fov_deg = fov ? fov->number(view.range) : view.default_deg;
    if (const auto filter = table.find("filter"))
        camera.filter = static_cast<PixelFilter>(filter->index_in(sensors::kPixelFilterNames, "filter"));
    return sensor;
}

SensorType read_type(const TomlTable& table) {
    const std::string_view type = table.choose("type", sensors::kSensorTypeNames);
    const auto place = std::find(sensors::kSensorTypeNames.begin(), sensors::kSensorTypeNames.end(), type);
    return static_cast<SensorType>(place - sensors::kSensorTypeNames.begin());
}

Sensor read_sensor(TomlTable& table, SensorType type, Warnings& warnings) {
    switch (type) {
        case SensorType::illuminance:
            return read_illuminance(table, warnings);
        case SensorType::grid:
            return read_grid(table, warnings);
        case SensorType::luminance:
            return read_luminance(table, warnings);
        case SensorType::goniometer:
            return read_goniometer(table, warnings);
        case SensorType::camera:
            return read_camera(table);
    }
    return {};
}

}  // namespace

void read_sensors(const TomlTable& section, SceneFile& file) {
    std::int64_t readings = 0;
    for (auto& [name, table] : named_tables(section)) {
        const SensorType type = read_type(table);
        Sensor sensor = read_sensor(table, type, file.warnings);
        sensor.name = name;
        sensor.type = type;
        readings += static_cast<std::int64_t>(sensor.measurands.size());
        if (readings > kMostReadings) {
            table.fail(fmt::format("the sensors so far have {} readings. Allowed: {} in all.", readings,
                                   kMostReadings));
        }
        file.sensors.push_back(std::move(sensor));
    }
}

}  // namespace stilb::io
