// The keys of areas: polygons and bands.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/scene/fields.h"

namespace stilb::io {
namespace {

constexpr Range kWidth{1e-3, 1e6, "a width from 0.001 to 1e6 m"};

/// [x, y, z], or [x, y] at the given height.
Vec3 read_corner(const TomlItem& item, const std::optional<double>& height_m) {
    if (!height_m) {
        if (item.elements().size() == 2)
            item.fail(
                "found a pair [x, y], but no \"height\". Allowed: triples [x, y, z], or \"height\" as well.");
        return item.vector();
    }
    if (item.elements().size() == 3)
        item.fail("found a triple [x, y, z] beside \"height\". Allowed: pairs [x, y], or no \"height\".");
    const std::vector<double> pair = item.numbers(2, kCoordinate);
    return {pair[0], pair[1], *height_m};
}

std::vector<Vec3> read_corners(const TomlItem& list, const std::optional<double>& height_m) {
    std::vector<Vec3> corners;
    for (const TomlItem& corner : list.elements()) corners.push_back(read_corner(corner, height_m));
    return corners;
}

}  // namespace

sensors::PolygonInSpace read_polygon(const TomlTable& table) {
    if (table.one_of({"corners", "corner"}).key == "corner") {
        for (const char* key : {"height", "holes"}) table.expect_not_both("corner", key);
        const auto [corner, u, v] = read_rectangle(table);
        return {{corner, corner + u, corner + u + v, corner + v}, {}};
    }
    for (const char* key : {"edge_u", "edge_v"}) table.expect_not_both("corners", key);
    std::optional<double> height_m;
    if (const auto height = table.find("height")) height_m = height->number(kCoordinate);
    sensors::PolygonInSpace polygon{read_corners(table.at("corners"), height_m), {}};
    if (const auto holes = table.find("holes")) {
        for (const TomlItem& hole : holes->elements()) polygon.holes.push_back(read_corners(hole, height_m));
    }
    return polygon;
}

sensors::Band read_band(const TomlItem& item) {
    if (!item.is_table()) return {item.number(kWidth), {}};
    TomlTable table = item.table();
    table.expect_keys({"width", "require"});
    const Sensor as_a_sensor{"", Area{}};
    return {table.at("width").number(kWidth), read_requirements(table, as_a_sensor)};
}

}  // namespace stilb::io
