// Materials and objects of random scenes.
#include "random/generator.h"

namespace stilb::random {
namespace {

TomlValue colour(Draw& draw, double low, double high) {
    if (draw.chance(0.7)) return number(draw.between(low, high));
    return vector({draw.between(low, high), draw.between(low, high), draw.between(low, high)});
}

void add_harmonics(Draft& draft, Draw& draw, const std::string& material, const Vec3& center, double radius) {
    // Y_00 is 1 / sqrt(4 pi); the others are small, so that the radius stays above 0.
    TomlArray coefficients{number(radius * std::sqrt(4 * kPi))};
    for (int i = 0; i < 8; ++i) coefficients.push_back(number(radius * draw.between(-0.15, 0.15)));
    draft.add_object("harmonics", material)
        .set("coefficients", {std::move(coefficients)})
        .set("center", vector(center));
}

void add_tetrahedron(Draft& draft, const std::string& material, const Vec3& center, double radius) {
    const double r = radius;
    draft.add_object("polygons", material)
        .set("vertices", vectors({center + Vec3{r, r, r}, center + Vec3{-r, -r, r}, center + Vec3{-r, r, -r},
                                  center + Vec3{r, -r, -r}}))
        .set("faces", faces({{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}));
}

/// Glass, smooth or frosted: of a solid, or a sheet.
/// `size_m`: of the thing.
std::string add_clear_material(Draft& draft, Draw& draw, bool is_solid, double size_m) {
    const double ior = draw.between(1.1, 2);
    if (draw.chance(0.3)) {
        Part& frosted = draft.add_material("frosted")
                            .set("ior", number(ior))
                            .set("roughness", number(draw.between(0.3, 1)));
        if (!is_solid) frosted.set("thin", {true});
        return frosted.name;
    }
    Part& material = draft.add_material(is_solid ? "glass" : "pane").set("ior", number(ior));
    if (!is_solid) {
        material.set("internal_transmittance", number(draw.between(0.5, 1)));
    } else if (draw.chance(0.4)) {
        material.set("color", colour(draw, 0.2, 1)).set("distance", number(size_m * draw.by_size(0.3, 3)));
    }
    return material.name;
}

/// Thin, whatever the shape: of a closed one they are its shell.
std::string add_sheet_material(Draft& draft, Draw& draw) {
    if (draw.chance(0.3)) {
        const double share = draw.between(0.3, 0.8);
        return draft.add_material("glazing")
            .set("transmittance", number(share))
            .set("reflectance", number(draw.between(0.05, 1 - share)))
            .set("back_reflectance", number(draw.between(0.05, 1 - share)))
            .name;
    }
    if (draw.chance(0.2)) {
        const double openness = draw.by_size(0.01, 0.3);
        return draft.add_material("fabric")
            .set("openness", number(openness))
            .set("transmittance", number(openness + draw.between(0, 0.3)))
            .set("reflectance", colour(draw, 0.1, 0.4))
            .name;
    }
    return draft.add_material("translucent")
        .set("reflectance", colour(draw, 0.1, 0.4))
        .set("transmittance", colour(draw, 0.1, 0.4))
        .set("specular_transmittance", number(draw.chance(0.5) ? 0 : draw.between(0, 0.2)))
        .name;
}

/// Opaque materials get another one on their back, translucent sheets another reflectance.
void add_back(Draft& draft, Draw& draw, const std::string& material) {
    const auto part = [&](std::string_view name) {
        return std::ranges::find(draft.materials, name, &Part::name);
    };
    const std::string type = part(material)->text("type");
    if (type == "translucent" || type == "fabric") {
        Part back;
        back.set("reflectance", colour(draw, 0.05, 0.4));
        part(material)->set("back", {back.keys});
    } else if (type != "glass" && type != "pane" && type != "glazing" && type != "frosted") {
        const auto back = part(add_material(draft, draw));
        TomlMembers keys = std::move(back->keys);
        draft.materials.erase(back);
        part(material)->set("back", {std::move(keys)});
    }
}

void add_thing(Draft& draft, Draw& draw, const Site& site) {
    const double radius = site.least() * draw.by_size(0.02, 0.25);
    const Vec3 margin{radius, radius, radius};
    const Vec3 center = draw.inside(site.low + 1.3 * margin, site.high - 1.3 * margin);
    const std::size_t shape = draw.weighted({3, 3, 2, 2, 2, 1});
    const bool is_solid = shape != 2 && shape != 3;
    const std::string material = draw.chance(0.06)   ? add_clear_material(draft, draw, is_solid, radius)
                                 : draw.chance(0.06) ? add_sheet_material(draft, draw)
                                                     : add_material(draft, draw);
    if (draw.chance(0.2)) add_back(draft, draw, material);
    switch (shape) {
        case 0:
            draft.add_object("box", material)
                .set("min", vector(center - draw.between(0.3, 0.9) * margin))
                .set("max", vector(center + draw.between(0.3, 0.9) * margin));
            break;
        case 1:
            draft.add_object("sphere", material).set("center", vector(center)).set("radius", number(radius));
            break;
        case 2:
            draft.add_object("disk", material)
                .set("center", vector(center))
                .set("normal", vector(draw.direction()))
                .set("radius", number(radius));
            break;
        case 3: {
            const Frame frame = Frame::around(draw.direction());
            draft.add_object("rectangle", material)
                .set("corner", vector(center - 0.5 * radius * (frame.u + frame.v)))
                .set("edge_u", vector(radius * frame.u))
                .set("edge_v", vector(radius * frame.v));
            break;
        }
        case 4:
            add_tetrahedron(draft, material, center, 0.7 * radius);
            break;
        default:
            add_harmonics(draft, draw, material, center, 0.7 * radius);
    }
}

}  // namespace

std::string add_plain_material(Draft& draft, double reflectance) {
    return draft.add_material("diffuse").set("reflectance", number(reflectance)).name;
}

std::string add_material(Draft& draft, Draw& draw) {
    switch (draw.weighted({12, 2, 1, 1, 1, 1, 2})) {
        case 0:
            return draft.add_material("diffuse")
                .set("reflectance", colour(draw, 0.05, draw.chance(0.1) ? 0.95 : 0.8))
                .name;
        case 1:
            return draft.add_material("phong")
                .set("diffuse", colour(draw, 0.1, 0.5))
                .set("specular", number(draw.between(0.05, 0.3)))
                .set("exponent", number(draw.by_size(1, 100)))
                .name;
        case 2:
            return draft.add_material("rough")
                .set("reflectance", colour(draw, 0.3, 0.8))
                .set("roughness", number(draw.between(0.3, 1)))
                .name;
        case 3:
            return draft.add_material("ward")
                .set("diffuse", colour(draw, 0.1, 0.5))
                .set("specular", number(draw.between(0.05, 0.3)))
                .set("roughness", {TomlArray{number(draw.between(0.2, 0.6)), number(draw.between(0.2, 0.6))}})
                .name;
        case 4:
            return draft.add_material("plastic")
                .set("diffuse", colour(draw, 0.2, 0.7))
                .set("ior", number(draw.between(1.2, 1.8)))
                .set("roughness", number(draw.between(0.2, 0.6)))
                .name;
        case 5:
            return draft.add_material("mirror").set("reflectance", number(draw.between(0.5, 0.95))).name;
        default:
            return draft.add_material("black").name;
    }
}

void fill_up(Draft& draft, std::size_t triangles, const Site& site) {
    std::size_t count = 0;
    for (const Part& object : draft.objects) {
        const std::string shape = object.text("shape");
        if (shape == "box") count += 12;
        if (shape == "rectangle") count += 2;
        if (shape != "polygons") continue;
        for (const TomlValue& face : std::get<TomlArray>(object.find("faces")->content))
            count += std::get<TomlArray>(face.content).size() - 2;
    }
    if (count >= triangles) return;
    const auto missing = static_cast<std::int64_t>(triangles - count);
    const double size = 1e-3 * site.least();
    std::vector<Vec3> vertices;
    std::vector<std::vector<std::int64_t>> corners;
    for (std::int64_t i = 0; i < missing + 2; ++i) {
        vertices.push_back(site.at({0.5, 0.5, 0.15}) +
                           size * Vec3{static_cast<double>(i / 2), static_cast<double>(i % 2), 0});
        if (i >= missing) continue;
        // A strip: every other triangle runs the other way.
        if (i % 2 == 0)
            corners.push_back({i, i + 2, i + 1});
        else
            corners.push_back({i, i + 1, i + 2});
    }
    draft.add_object("polygons", add_plain_material(draft, 0.5))
        .set("vertices", vectors(vertices))
        .set("faces", faces(corners));
}

void add_things(Draft& draft, Draw& draw, const Site& site) {
    // 96 triangles and fewer are tested without a tree: boxes have 12 of them.
    const std::size_t count = draw.one_of<std::size_t>({0, 0, 1, 2, 3, 6, 8, 12});
    for (std::size_t i = 0; i < count; ++i) add_thing(draft, draw, site);
    if (!draw.chance(0.12)) return;
    // Something far away, as of a drawing or a sun.
    const double distance = draw.by_size(10, 1e5) * site.least(), size = distance * draw.by_size(1e-6, 0.1);
    const Vec3 at = site.at({0.5, 0.5, 0.5}) + distance * draw.direction();
    draft.add_object("rectangle", add_plain_material(draft, 0.3))
        .set("corner", vector(at))
        .set("edge_u", vector({size, 0, 0}))
        .set("edge_v", vector({0, size, 0}));
}

}  // namespace stilb::random
