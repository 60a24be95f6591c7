// Sensors of type "plane": working planes over floors.
#include <fmt/format.h>

#include "io/scene/fields.h"
#include "io/scene/sections.h"
#include "sensors/areas/working_planes.h"

namespace stilb::io {
namespace {

constexpr Range kHeight{0, 100, "a height from 0 to 100 m"};
constexpr Range kMargin{0, 100, "a distance from 0 to 100 m"};
constexpr Range kSpacing{1e-3, 1e6, "a length from 0.001 to 1e6 m, or \"auto\""};

std::optional<double> read_spacing(const TomlTable& table) {
    const auto item = table.find("spacing");
    if (!item || (item->is_text() && item->text() == "auto")) return std::nullopt;
    return item->number(kSpacing);
}

std::vector<ObjectId> read_floors(const TomlTable& table, const Scene& scene) {
    std::vector<ObjectId> floors;
    const auto given = table.find("object");
    if (!given) return floors;
    std::vector<std::string_view> names;
    for (const Object& object : scene.objects) names.push_back(object.name);
    for (const TomlItem& name : given->is_array() ? given->elements() : std::vector{*given})
        floors.push_back(static_cast<ObjectId>(name.index_in(names, "object")));
    return floors;
}

sensors::PolygonInSpace read_floor(const TomlItem& polygon) {
    sensors::PolygonInSpace floor;
    for (const TomlItem& corner : polygon.elements()) {
        floor.outline.push_back(corner.vector());
        if (floor.outline.back().z != floor.outline.front().z)
            corner.fail("lies at another height than the first corner. Allowed: corners of a level floor.");
    }
    if (floor.outline.size() < 3)
        polygon.fail("has too few corners. Allowed: three corners [x, y, z] of the floor, or more.");
    return floor;
}

}  // namespace

std::vector<std::string_view> plane_keys() {
    return {"type", "object", "polygon", "height", "margin", "spacing", "require"};
}

std::vector<Sensor> read_planes(const std::string& name, TomlTable& table, const Scene& scene) {
    table.expect_keys(plane_keys(), "type \"plane\"");
    table.expect_not_both("object", "polygon");
    sensors::WorkingPlaneOptions options;
    if (const auto height = table.find("height")) options.height_m = height->number(kHeight);
    if (const auto margin = table.find("margin")) options.margin_m = margin->number(kMargin);
    const auto polygon = table.find("polygon");
    const std::vector<sensors::WorkingPlane> planes =
        polygon ? working_planes(read_floor(*polygon), options)
                : working_planes(scene, rays::RayCaster(scene), options, read_floors(table, scene));
    std::vector<Sensor> all = sensors_on(planes, name, read_spacing(table));
    if (all.empty()) table.fail(sensors::no_plane_message(options));
    for (Sensor& sensor : all) sensor.requirements = read_requirements(table, sensor);
    return all;
}

}  // namespace stilb::io
