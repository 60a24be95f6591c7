// Additions to some random scenes: files, colours, sensors of rooms and of glare by daylight.
#include "random/generator.h"

namespace stilb::random {
namespace {

void add_panorama(Draft& draft, Draw& draw, std::string& kind) {
    for (Part& light : draft.lights) {
        if (light.text("type") != "environment") continue;
        light.set("file", text(kSkyFile)).set("dimming", *light.find("luminance"));
        light.set("rotation", number(draw.between(-180, 180)));
        light.erase("luminance");
        kind += ", panorama";
    }
}

/// A thing of a mesh file, which may shine.
void add_mesh(Draft& draft, Draw& draw, const Site& site, std::string& kind) {
    const double size = site.least() * draw.by_size(0.03, 0.3);
    const Vec3 margin{0.8 * size, 0.8 * size, 0.6 * size};
    Part& object =
        draft.add_object("mesh", add_material(draft, draw))
            .set("file", text(kThingFiles[draw.below(2)]))
            .set("scale", number(size))
            .set("rotate", {TomlArray{number(0), number(0), number(1), number(draw.between(-180, 180))}})
            .set("translate", vector(draw.inside(site.low + margin, site.high - margin)));
    const std::string name = object.name;
    kind += ", mesh file";
    if (draw.chance(0.3))
        draft.add_light("area").set("object", text(name)).set("luminance", number(draw.by_size(1, 1e4)));
}

/// Luminaires with openings get bodies.
void add_bodies(Draft& draft, Draw& draw, std::string& kind) {
    std::string material;
    for (Part& light : draft.lights) {
        if (light.text("type") != "photometry" || light.text("opening") == "point") continue;
        if (material.empty()) {
            material = add_plain_material(draft, draw.between(0.1, 0.8));
            kind += ", with bodies";
        }
        const auto& opening = std::get<TomlArray>(light.find("opening")->content);
        const double width = 1.1 * std::max(as_number(opening[0]), as_number(opening[1]));
        light.set("geometry", {TomlMembers{{"file", 0, text(kBodyFile)},
                                           {"material", 0, text(material)},
                                           {"scale", 0, number(width)}}});
    }
}

void add_colours(Draft& draft, Draw& draw) {
    for (Part& light : draft.lights) {
        if (light.find("file") && light.text("type") == "environment") continue;
        if (draw.chance(0.5))
            light.set("cct", number(draw.between(1000, 25000)));
        else
            light.set("color", vector({draw.between(0.1, 1), draw.between(0, 1), draw.between(0, 1)}));
    }
}

void change_projections(Draft& draft, Draw& draw) {
    for (Part& sensor : draft.sensors) {
        if (sensor.text("type") != "camera" || draw.chance(0.5)) continue;
        const bool is_fisheye = draw.chance(0.5);
        sensor.set("projection", text(is_fisheye ? "fisheye" : "panorama"));
        sensor.set("fov", number(is_fisheye ? 180 : 360));
        if (!is_fisheye) sensor.set("resolution", integers({12, 6}));
    }
}

/// A working plane, or the walls of the room.
void add_sensor_of_room(Draft& draft, Draw& draw, const Site& site) {
    // Rooms of ordinary size with a level floor: smaller ones are none, larger ones have many points.
    const bool is_round = !draft.objects.empty() && draft.objects[0].text("shape") == "sphere";
    if (!site.is_closed || is_round || site.size().z < 2 || site.size().x > 20 || site.size().y > 20) return;
    if (draw.chance(0.5)) {
        draft.add_sensor("plane")
            .set("height", number(draw.between(0, 0.4) * site.size().z))
            .set("margin", number(draw.between(0.05, 0.2) * site.least()))
            .set("spacing", number(0.2 * site.size().x));
    } else {
        draft.add_sensor("area")
            .set("room", vector(site.at({0.3, 0.4, 0.4})))
            .set("part", text(draw.one_of({"walls", "ceiling", "floor"})))
            .set("spacing", number(0.6 * site.size().x));
    }
}

void add_eye(Draft& draft, Draw& draw, const Site& site) {
    const double phi = draw.between(0, 2 * kPi);
    draft.add_sensor("dgp")
        .set("position", vector(draw.inside(site.at({0.1, 0.1, 0.2}), site.at({0.9, 0.9, 0.7}))))
        .set("direction", vector({std::cos(phi), std::sin(phi), 0}));
}

/// Everything else stands on it, or it lies far below.
void add_wide_ground(Draft& draft, Draw& draw, const Site& site, std::string& kind) {
    const double size = site.least() * draw.by_size(1e2, 1e5), down = draw.one_of({0.0, 0.1, 10.0});
    const Vec3 middle = site.at({0.5, 0.5, -down});
    draft.add_object("rectangle", add_material(draft, draw))
        .set("corner", vector(middle - Vec3{size / 2, size / 2, 0.01 * site.size().z}))
        .set("edge_u", vector({size, 0, 0}))
        .set("edge_v", vector({0, size, 0}));
    kind += ", wide ground";
}

}  // namespace

void add_extras(Draft& draft, Draw& draw, const Site& site, std::string& kind) {
    if (draw.chance(0.3)) add_panorama(draft, draw, kind);
    for (std::size_t i = draw.chance(0.15) ? 1 + draw.below(3) : 0; i > 0; --i)
        add_mesh(draft, draw, site, kind);
    if (draw.chance(0.4)) add_bodies(draft, draw, kind);
    if (draw.chance(0.2)) add_colours(draft, draw);
    change_projections(draft, draw);
    if (draw.chance(0.15)) add_sensor_of_room(draft, draw, site);
    // Each measurement makes a picture at the eye, which takes seconds where there are many lamps.
    if (draft.lights.size() < 5 && draw.chance(0.015)) add_eye(draft, draw, site);
    if (!site.is_closed && draw.chance(0.25)) add_wide_ground(draft, draw, site, kind);
}

}  // namespace stilb::random
