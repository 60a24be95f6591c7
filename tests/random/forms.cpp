#include "random/forms.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "random/generator.h"
#include "random/motion.h"

namespace stilb::random {
namespace {

constexpr std::array<std::string_view, static_cast<std::size_t>(Form::count)> kWords{
    "as it is",     "moved",     "turned",       "mirrored",   "scaled",       "in another order",
    "lamps halved", "faces cut", "other shapes", "far object", "black object", "arrays written out",
    "as openings"};

using Forms = std::optional<OtherForm>;

Forms moved(const Draft& draft, Draw& draw) {
    Motion motion;
    motion.shift = draw.chance(0.5) ? Vec3{3.5e6, 5.4e6, 210} : draw.by_size(0.1, 1000) * draw.direction();
    if (farthest_coordinate(draft) > 1e6) motion.shift = -1 * Vec3{3.5e6, 5.4e6, 117};
    return OtherForm{in_motion(draft, motion)};
}

Forms turned(const Draft& draft, Draw& draw) {
    const Vec3 axis = depends_on_vertical(draft) ? Vec3{0, 0, 1} : draw.direction();
    const double angle = draw.chance(0.5) ? draw.one_of({90., 180., -90.}) : draw.between(-180, 180);
    return OtherForm{in_motion(draft, turn_about(axis, angle))};
}

Forms mirrored(const Draft& draft, Draw&) {
    if (depends_on_hand(draft)) return std::nullopt;
    Motion motion;
    motion.x = {-1, 0, 0};
    motion.is_mirrored = true;
    return OtherForm{in_motion(draft, motion)};
}

Forms scaled(const Draft& draft, Draw& draw) {
    Motion motion;
    motion.scale = draw.one_of({0.01, 0.5, 2.0, 100.0});
    if (motion.scale * farthest_coordinate(draft) > 1e7) motion.scale = 0.5;
    return OtherForm{in_motion(draft, motion)};
}

void shuffle(std::vector<Part>& parts, Draw& draw) {
    for (std::size_t i = parts.size(); i > 1; --i) std::swap(parts[i - 1], parts[draw.below(i)]);
}

Forms reordered(const Draft& draft, Draw& draw) {
    OtherForm other{draft};
    shuffle(other.draft.objects, draw);
    shuffle(other.draft.lights, draw);
    shuffle(other.draft.materials, draw);
    return other;
}

void halve_flux(Part& light) { light.set("flux", number(0.5 * light.number("flux"))); }

/// Points in two of half the flux in one place, rectangles and openings in two halves side by side.
Forms with_lamps_halved(const Draft& draft, Draw&) {
    // Glare counts lamps, and leaves out small ones.
    for (const Part& sensor : draft.sensors) {
        if (sensor.text("type") == "ugr" || sensor.text("type") == "dgp") return std::nullopt;
    }
    OtherForm other{draft};
    other.draft.lights.clear();
    bool is_other = false;
    for (const Part& whole : draft.lights) {
        Part first = whole, second = whole;
        second.name = other.draft.new_name("l");
        const std::string type = whole.text("type");
        const bool is_point = type == "point" || (type == "photometry" && whole.text("opening") == "point");
        const bool hangs = type == "photometry" && !is_point && !whole.find("aim") && !whole.find("geometry");
        const Part* const object = draft.object(whole.text("object"));
        const bool is_rectangle = type == "area" && object->text("shape") == "rectangle";
        if (!whole.find("flux") || !(is_point || is_rectangle || (hangs && whole.find("position")))) {
            other.draft.lights.push_back(whole);
            continue;
        }
        is_other = true;
        halve_flux(first);
        halve_flux(second);
        if (is_rectangle) {
            const Vec3 half = 0.5 * object->vector("edge_u");
            Part rest = *object;
            rest.name = other.draft.new_name("o");
            rest.set("edge_u", vector(half)).set("corner", vector(object->vector("corner") + half));
            second.set("object", text(rest.name));
            other.draft.object(object->name)->set("edge_u", vector(half));
            other.draft.objects.push_back(std::move(rest));
        } else if (!is_point) {
            const double spin = (whole.find("spin") ? whole.number("spin") : 0) * kPi / 180;
            const auto& opening = std::get<TomlArray>(whole.find("opening")->content);
            const double half = 0.5 * as_number(opening[0]);
            const Vec3 along = 0.5 * half * Vec3{-std::sin(spin), std::cos(spin), 0};
            const TomlValue half_opening{TomlArray{number(half), opening[1]}};
            const Vec3 position = whole.vector("position");
            first.set("opening", half_opening).set("position", vector(position - along));
            second.set("opening", half_opening).set("position", vector(position + along));
        }
        other.draft.lights.push_back(std::move(first));
        other.draft.lights.push_back(std::move(second));
    }
    if (!is_other) return std::nullopt;
    return other;
}

/// Cells of a parallelogram, `parts` to a side, added to lists of vertices and faces.
void add_cells(std::vector<Vec3>& vertices, TomlArray& faces, const Vec3& corner, const Vec3& edge_u,
               const Vec3& edge_v, int parts) {
    const auto first = static_cast<std::int64_t>(vertices.size());
    for (int j = 0; j <= parts; ++j) {
        for (int i = 0; i <= parts; ++i)
            vertices.push_back(corner + (1. * i / parts) * edge_u + (1. * j / parts) * edge_v);
    }
    for (int j = 0; j < parts; ++j) {
        for (int i = 0; i < parts; ++i) {
            const std::int64_t a = first + j * (parts + 1) + i;
            faces.push_back({TomlArray{{a}, {a + 1}, {a + parts + 2}, {a + parts + 1}}});
        }
    }
}

Part as_polygons(const Part& object, const std::vector<Vec3>& vertices, TomlArray faces) {
    Part result{object.name, {}};
    result.set("shape", text("polygons")).set("material", *object.find("material"));
    result.set("vertices", vectors(vertices)).set("faces", {std::move(faces)});
    return result;
}

Forms with_faces_cut(const Draft& draft, int parts) {
    OtherForm other{draft};
    bool is_other = false;
    for (Part& object : other.draft.objects) {
        std::vector<Vec3> vertices;
        TomlArray faces;
        if (object.text("shape") == "rectangle") {
            add_cells(vertices, faces, object.vector("corner"), object.vector("edge_u"),
                      object.vector("edge_v"), parts);
        } else if (object.text("shape") == "box") {
            const Vec3 a = object.vector("min"), b = object.vector("max"), e = b - a;
            const Vec3 x{e.x, 0, 0}, y{0, e.y, 0}, z{0, 0, e.z};
            add_cells(vertices, faces, a, y, x, parts);
            add_cells(vertices, faces, a + z, x, y, parts);
            add_cells(vertices, faces, a, z, y, parts);
            add_cells(vertices, faces, a + x, y, z, parts);
            add_cells(vertices, faces, a, x, z, parts);
            add_cells(vertices, faces, a + y, z, x, parts);
        } else {
            continue;
        }
        object = as_polygons(object, vertices, std::move(faces));
        is_other = true;
    }
    if (!is_other) return std::nullopt;
    return other;
}

Forms with_far_object(const Draft& draft, Draw& draw) {
    OtherForm other{draft};
    const double farthest = std::max(1.0, farthest_coordinate(draft));
    const double distance = draw.by_size(1, std::min(1e5, 1e7 / farthest)) * farthest;
    // It hides a millionth of the sky.
    const double size = 1e-3 * distance;
    const std::string black = other.draft.add_material("black").name;
    other.draft.add_object("rectangle", black)
        .set("corner", vector(distance * draw.direction()))
        .set("edge_u", vector({size, 0, 0}))
        .set("edge_v", vector({0, size, 0}));
    return other;
}

bool is_inside(const Part& object, const Vec3& p) {
    if (object.text("shape") == "sphere")
        return length(p - object.vector("center")) < object.number("radius");
    const Vec3 a = object.vector("min"), b = object.vector("max");
    return a.x < p.x && p.x < b.x && a.y < p.y && p.y < b.y && a.z < p.z && p.z < b.z;
}

/// The points that parts stand at.
std::vector<Vec3> places_of(const Draft& draft) {
    std::vector<Vec3> places;
    for (const auto* const parts : {&draft.objects, &draft.lights, &draft.sensors}) {
        for (const Part& part : *parts) {
            for (const char* const key :
                 {"position", "corner", "center", "min", "max", "point", "translate"}) {
                if (part.find(key)) places.push_back(part.vector(key));
            }
            for (const char* const key : {"positions", "vertices"}) {
                const TomlValue* const list = part.find(key);
                if (!list) continue;
                for (const TomlValue& point : std::get<TomlArray>(list->content))
                    places.push_back(as_vector(point));
            }
        }
    }
    return places;
}

/// Where nobody looks: inside of a closed opaque object that holds nothing else.
Forms with_black_object(const Draft& draft, Draw&) {
    const std::vector<Vec3> places = places_of(draft);
    OtherForm other{draft};
    for (const Part& object : draft.objects) {
        const bool is_box = object.text("shape") == "box";
        if (!is_box && object.text("shape") != "sphere") continue;
        const Vec3 middle =
            is_box ? 0.5 * (object.vector("min") + object.vector("max")) : object.vector("center");
        const bool holds_more = std::ranges::any_of(places, [&](const Vec3& place) {
            return length(place - middle) > 0 && is_inside(object, place);
        });
        const auto material =
            std::ranges::find(draft.materials, object.text("material"), &Part::name)->text("type");
        constexpr std::array<std::string_view, 6> clear{"glass",   "pane",        "glazing",
                                                        "frosted", "translucent", "fabric"};
        if (holds_more || std::ranges::find(clear, material) != clear.end()) continue;
        const Vec3 size = is_box ? object.vector("max") - object.vector("min") : Vec3{};
        const double radius = 0.3 * (is_box ? std::min({size.x, size.y, size.z}) : object.number("radius"));
        other.draft.add_object("sphere", other.draft.add_material("black").name)
            .set("center", vector(middle))
            .set("radius", number(radius));
        return other;
    }
    return std::nullopt;
}

Forms with_arrays_written_out(const Draft& draft, Draw&) {
    OtherForm other{draft};
    other.draft.lights.clear();
    bool is_other = false;
    for (const Part& light : draft.lights) {
        const TomlValue* const positions = light.find("positions");
        const TomlValue* const array = light.find("array");
        std::vector<Vec3> places;
        if (positions) {
            for (const TomlValue& point : std::get<TomlArray>(positions->content))
                places.push_back(as_vector(point));
        } else if (array) {
            const Part table{"", std::get<TomlMembers>(array->content)};
            const auto step = [&](const char* key) { return table.find(key) ? table.vector(key) : Vec3{}; };
            const auto& count = std::get<TomlArray>(table.find("count")->content);
            for (int j = 0; j < as_number(count[1]); ++j) {
                for (int i = 0; i < as_number(count[0]); ++i)
                    places.push_back(table.vector("origin") + i * step("step_u") + j * step("step_v"));
            }
        } else {
            other.draft.lights.push_back(light);
            continue;
        }
        is_other = true;
        for (const Vec3& place : places) {
            Part one = light;
            one.name = other.draft.new_name("l");
            one.erase("positions");
            one.erase("array");
            one.set(light.text("type") == "sphere" ? "center" : "position", vector(place));
            other.draft.lights.push_back(std::move(one));
        }
    }
    if (!is_other) return std::nullopt;
    return other;
}

/// Black rectangles that shine downwards as luminaires of a cosine.
Forms as_openings(const Draft& draft, Draw&) {
    OtherForm other{draft};
    bool is_other = false;
    for (Part& light : other.draft.lights) {
        const Part* const object = draft.object(light.text("object"));
        if (!object || object->text("shape") != "rectangle" || !light.find("flux")) continue;
        const auto material = std::ranges::find(draft.materials, object->text("material"), &Part::name);
        const Vec3 u = object->vector("edge_u"), v = object->vector("edge_v");
        if (material->text("type") != "black" || normalized(cross(u, v)).z > -1 + 1e-12) continue;
        const std::string name = light.name;
        std::erase_if(other.draft.objects, [&](const Part& part) { return part.name == object->name; });
        const TomlValue flux = *light.find("flux");
        light.keys.clear();
        light.set("type", text("photometry"))
            .set("file", text(kCosineFile))
            .set("position", vector(object->vector("corner") + 0.5 * u + 0.5 * v))
            .set("opening", {TomlArray{number(length(u)), number(length(v))}})
            .set("spin", number(std::atan2(-u.x, u.y) * 180 / kPi))
            .set("flux", flux);
        is_other = true;
    }
    if (!is_other) return std::nullopt;
    return other;
}

}  // namespace

std::string_view words(Form form) { return kWords[static_cast<std::size_t>(form)]; }

std::optional<OtherForm> in_form(const Draft& draft, Form form, Draw& draw) {
    switch (form) {
        case Form::moved:
            return moved(draft, draw);
        case Form::turned:
            return turned(draft, draw);
        case Form::mirrored:
            return mirrored(draft, draw);
        case Form::scaled:
            return scaled(draft, draw);
        case Form::reordered:
            return reordered(draft, draw);
        case Form::lamps_halved:
            return with_lamps_halved(draft, draw);
        case Form::faces_cut:
            return with_faces_cut(draft, static_cast<int>(2 + draw.below(6)));
        case Form::other_shapes:
            return with_faces_cut(draft, 1);
        case Form::far_object:
            return with_far_object(draft, draw);
        case Form::black_object:
            return with_black_object(draft, draw);
        case Form::arrays_written_out:
            return with_arrays_written_out(draft, draw);
        case Form::as_openings:
            return as_openings(draft, draw);
        default:
            return OtherForm{draft};
    }
}

}  // namespace stilb::random
