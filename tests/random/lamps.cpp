// Lamps of random scenes: from one to 200, of one kind or of all.
#include <fmt/format.h>

#include "random/generator.h"

namespace stilb::random {
namespace {

enum class Lamp { point, ball, rectangle, disk, box, sphere_object, mesh, beam, opening, washer };

constexpr const char* kLampNames[] = {"points",  "balls",  "rectangles", "disks",    "boxes",
                                      "spheres", "meshes", "beams",      "openings", "washers"};

void add_area(Draft& draft, const Part& object, double flux) {
    const std::string name = object.name;
    draft.add_light("area").set("object", text(name)).set("flux", number(flux));
}

/// `size`: its radius, or half its edge.
void add_lamp(Draft& draft, Draw& draw, Lamp kind, const Vec3& at, double size, double flux) {
    const auto material = [&] {
        return draw.chance(0.5) ? draft.add_material("black").name
                                : add_plain_material(draft, draw.between(0.1, 0.7));
    };
    const auto photometry = [&](const char* file, TomlValue opening) {
        Part& light = draft.add_light("photometry")
                          .set("file", text(file))
                          .set("position", vector(at))
                          .set("flux", number(flux))
                          .set("opening", std::move(opening));
        if (draw.chance(0.3)) light.set("spin", number(draw.between(-180, 180)));
        if (draw.chance(0.2)) light.set("aim", vector(draw.direction()));
    };
    switch (kind) {
        case Lamp::point:
            draft.add_light("point").set("position", vector(at)).set("flux", number(flux));
            break;
        case Lamp::ball:
            draft.add_light("sphere")
                .set("center", vector(at))
                .set("radius", number(size))
                .set("flux", number(flux));
            break;
        case Lamp::rectangle: {
            const bool is_tilted = draw.chance(0.2);
            const Frame frame = Frame::around(is_tilted ? draw.direction() : Vec3{0, 0, -1});
            const double length = draw.between(0.5, 2);
            add_area(draft,
                     draft.add_object("rectangle", material())
                         .set("corner", vector(at - size * frame.u - length * size * frame.v))
                         .set("edge_u", vector(2 * size * frame.u))
                         .set("edge_v", vector(2 * length * size * frame.v)),
                     flux);
            break;
        }
        case Lamp::disk:
            add_area(draft,
                     draft.add_object("disk", material())
                         .set("center", vector(at))
                         .set("normal", vector(draw.chance(0.2) ? draw.direction() : Vec3{0, 0, -1}))
                         .set("radius", number(size)),
                     flux);
            break;
        case Lamp::box:
            add_area(draft,
                     draft.add_object("box", material())
                         .set("min", vector(at - Vec3{size, size, 0.3 * size}))
                         .set("max", vector(at + Vec3{size, size, 0.3 * size})),
                     flux);
            break;
        case Lamp::sphere_object:
            add_area(
                draft,
                draft.add_object("sphere", material()).set("center", vector(at)).set("radius", number(size)),
                flux);
            break;
        case Lamp::mesh:
            add_area(draft,
                     draft.add_object("polygons", material())
                         .set("vertices", vectors({at - Vec3{size, size, 0}, at + Vec3{size, -size, 0},
                                                   at + Vec3{size, size, 0}, at + Vec3{-size, size, 0}}))
                         .set("faces", faces({{0, 2, 1}, {0, 3, 2}})),
                     flux);
            break;
        case Lamp::beam:
            photometry(kBeamFile, text("point"));
            break;
        case Lamp::opening:
            photometry(kCosineFile, {TomlArray{number(2 * size), number(size * draw.between(0.5, 4))}});
            break;
        case Lamp::washer:
            photometry(kWasherFile, {TomlArray{number(2 * size), number(size * draw.between(0.5, 4))}});
            break;
    }
}

/// Lamps of one table: an array in the raster, or positions anywhere. Only lamps with a position can be so.
bool add_as_one_table(Draft& draft, Draw& draw, Lamp kind, const std::vector<Vec3>& places,
                      std::size_t columns, double size, double flux) {
    const bool has_position = kind == Lamp::point || kind == Lamp::ball || kind >= Lamp::beam;
    if (!has_position || places.size() < 2) return false;
    add_lamp(draft, draw, kind, places[0], size, flux);
    Part& light = draft.lights.back();
    light.erase("position");
    light.erase("center");
    if (columns == places.size() || places.size() % columns != 0 || draw.chance(0.5)) {
        light.set("positions", vectors(places));
        return true;
    }
    const std::size_t rows = places.size() / columns;
    TomlMembers array{{"origin", 0, vector(places[0])}};
    if (columns > 1) array.push_back({"step_u", 0, vector(places[1] - places[0])});
    if (rows > 1) array.push_back({"step_v", 0, vector(places[columns] - places[0])});
    array.push_back({"count", 0, integers({columns, rows})});
    light.set("array", {std::move(array)});
    return true;
}

std::size_t draw_count(Draw& draw) {
    if (draw.chance(0.6)) return draw.one_of<std::size_t>({1, 1, 1, 2, 3, 5, 9});
    return draw.one_of<std::size_t>({15, 16, 17, 31, 32, 33, 34, 63, 64, 65, 100, 200});
}

/// A second lamp in the place of the last one.
void add_twin(Draft& draft) {
    Part light = draft.lights.back();
    light.name = draft.new_name("l");
    if (const Part* const object = draft.object(light.text("object"))) {
        Part twin = *object;
        twin.name = draft.new_name("o");
        light.set("object", text(twin.name));
        draft.objects.push_back(std::move(twin));
    }
    draft.lights.push_back(std::move(light));
}

}  // namespace

void add_lamps(Draft& draft, Draw& draw, const Site& site, std::string& kind) {
    const bool has_sky = !draft.lights.empty() && draft.lights[0].text("type") == "environment";
    if (has_sky && draw.chance(0.4)) return;
    const std::size_t count = draw_count(draw);
    const bool mixes = draw.chance(0.4);
    const auto draw_kind = [&] { return static_cast<Lamp>(draw.weighted({2, 2, 3, 2, 1, 1, 1, 1, 2, 1})); };
    const Lamp first = draw_kind();
    // In a raster below the ceiling, or anywhere.
    const bool is_raster = draw.chance(0.7);
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const double cell = 0.8 / static_cast<double>(columns);
    const double size = 0.5 * cell * site.least() * draw.by_size(0.05, 0.7);
    const double area = site.size().x * site.size().y;
    const double flux = 300 * area / static_cast<double>(count);
    const double spread = draw.one_of({1.0, 1.0, 3.0, 1e3});
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 in_raster{0.1 + cell * (0.5 + static_cast<double>(i % columns)),
                             0.1 + cell * (0.5 + static_cast<double>(i / columns)), 0.9};
        places.push_back(site.at(is_raster ? in_raster : draw.inside({0.1, 0.1, 0.3}, {0.9, 0.9, 0.9})));
    }
    const bool is_one_table =
        !mixes && draw.chance(0.5) &&
        add_as_one_table(draft, draw, first, places, is_raster ? columns : count, size, flux);
    for (std::size_t i = 0; i < count && !is_one_table; ++i) {
        add_lamp(draft, draw, mixes ? draw_kind() : first, places[i], size,
                 flux * draw.by_size(1 / spread, spread));
    }
    if (!is_one_table && draw.chance(0.06)) {
        add_twin(draft);
        kind += ", lamp twice";
    }
    kind += fmt::format(", {} {}", count, mixes && count > 1 ? "lamps" : kLampNames[static_cast<int>(first)]);
}

}  // namespace stilb::random
