// The keys of areas: polygons and bands.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "io/scene/fields.h"
#include "io/text/text.h"
#include "sensors/areas/rooms.h"
#include "sensors/areas/surface_points.h"

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
    const std::string given = table.one_of({"corners", "corner", "object", "room"}).key;
    if (given == "object" || given == "room") {
        for (const char* key : {"height", "holes", "edge_u", "edge_v"}) table.expect_not_both(given, key);
        return {};
    }
    if (given == "corner") {
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

sensors::Surfaces read_surfaces(const TomlTable& table) {
    sensors::Surfaces surfaces;
    if (const auto object = table.find("object")) {
        if (object->is_array()) {
            for (const TomlItem& name : object->elements()) surfaces.objects.emplace_back(name.text());
            if (surfaces.objects.empty())
                object->fail("found no object. Allowed: the name of an object, or a list of names.");
        } else {
            surfaces.objects.emplace_back(object->text());
        }
    }
    if (const auto room = table.find("room")) surfaces.room = room->vector();
    if (const auto part = table.find("part"))
        surfaces.part = static_cast<sensors::SurfacePart>(part->index_in(sensors::kSurfacePartNames, "part"));
    return surfaces;
}

namespace {

/// The triangles of an object with plane faces.
Mesh plane_mesh_of(const TomlItem& item, const Object& object) {
    if (const geometry::MeshInWorld mesh(object.shape); mesh) return *mesh;
    if (const auto* box = std::get_if<Box>(&object.shape)) return triangulated(*box);
    if (const auto* rectangle = std::get_if<Rectangle>(&object.shape)) return triangulated(*rectangle);
    item.fail(fmt::format("object {} has no plane faces. Allowed: meshes, polygons, boxes and rectangles.",
                          in_quotes(object.name)));
}

void place_on_objects(const TomlTable& table, const Scene& scene, Area& area) {
    std::vector<std::string_view> names;
    for (const Object& object : scene.objects) names.push_back(object.name);
    const TomlItem item = table.at("object");
    std::vector<sensors::PlaneFace> faces;
    for (const TomlItem& name : item.is_array() ? item.elements() : std::vector{item}) {
        const Object& object = scene.objects[name.index_in(names, "object")];
        std::ranges::copy_if(
            sensors::plane_faces(plane_mesh_of(name, object)), std::back_inserter(faces),
            [&](const sensors::PlaneFace& face) { return is_of_part(face, area.surfaces.part); });
    }
    if (faces.empty()) {
        table.at("part").fail(
            fmt::format("no face of the object is part of the {}: closed objects are measured inside, others "
                        "on their front. Allowed: another part or object.",
                        sensors::kSurfacePartNames[static_cast<std::size_t>(area.surfaces.part)]));
    }
    if (const auto fault = place_on(faces, area)) table.at(fault->key).fail(fault->message);
}

void place_in_room(const TomlTable& table, sensors::RoomsOnDemand& building, Area& area) {
    const sensors::Room* const room = room_at(building.rooms(), *area.surfaces.room);
    if (!room) {
        table.at("room").fail(
            "lies in no room. A room has a level floor of 1 m² or more, walls, and a ceiling 1.8 m or more "
            "above. Allowed: a point in a room, or \"object\" in place of \"room\".");
    }
    if (const auto fault = place_in(*room, building.scene(), building.caster(), area))
        table.at(table.find(fault->key) ? fault->key : "room").fail(fault->message);
}

}  // namespace

void place_on_surfaces(const TomlTable& table, sensors::RoomsOnDemand& building, Area& area) {
    if (area.surfaces.room) {
        place_in_room(table, building, area);
    } else {
        place_on_objects(table, building.scene(), area);
    }
}

sensors::Band read_band(const TomlItem& item) {
    if (!item.is_table()) return {item.number(kWidth), {}};
    TomlTable table = item.table();
    table.expect_keys({"width", "require"});
    const Sensor as_a_sensor{"", Area{}};
    return {table.at("width").number(kWidth), read_requirements(table, as_a_sensor)};
}

}  // namespace stilb::io
