// Rooms of random scenes: closed ones of all shapes, with holes, two at a time, ground and sky, or none.
#include "random/generator.h"

namespace stilb::random {
namespace {

/// One side of a box: its corner and edges, the front inside.
struct Side {
    Vec3 corner, edge_u, edge_v;
};

std::vector<Side> sides_of(const Vec3& low, const Vec3& high) {
    const Vec3 e = high - low, x{e.x, 0, 0}, y{0, e.y, 0}, z{0, 0, e.z};
    return {{low, x, y}, {low + z, y, x}, {low, y, z}, {low + x, z, y}, {low, z, x}, {low + y, x, z}};
}

Vec3 normal_of(const Side& side) { return normalized(cross(side.edge_u, side.edge_v)); }

void add_rectangle(Draft& draft, const Side& side, const std::string& material) {
    draft.add_object("rectangle", material)
        .set("corner", vector(side.corner))
        .set("edge_u", vector(side.edge_u))
        .set("edge_v", vector(side.edge_v));
}

/// A side with a hole in its middle, as four rectangles.
void add_with_hole(Draft& draft, const Side& side, double from, double to, const std::string& material) {
    const auto part = [&](double u0, double u1, double v0, double v1) {
        add_rectangle(draft,
                      {side.corner + u0 * side.edge_u + v0 * side.edge_v, (u1 - u0) * side.edge_u,
                       (v1 - v0) * side.edge_v},
                      material);
    };
    part(0, 1, 0, from);
    part(0, 1, to, 1);
    part(0, from, from, to);
    part(to, 1, from, to);
}

void add_mesh_room(Draft& draft, const Site& site, const std::string& material) {
    const Vec3 &a = site.low, &b = site.high;
    draft.add_object("polygons", material)
        .set("vertices", vectors({a,
                                  {b.x, a.y, a.z},
                                  {b.x, b.y, a.z},
                                  {a.x, b.y, a.z},
                                  {a.x, a.y, b.z},
                                  {b.x, a.y, b.z},
                                  b,
                                  {a.x, b.y, b.z}}))
        .set("faces",
             faces({{0, 1, 2, 3}, {7, 6, 5, 4}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}));
}

/// A plane ring of cells with a floor and a ceiling in L shape.
void add_l_room(Draft& draft, const Site& site, const std::string& material) {
    const std::vector<std::array<double, 2>> outline{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}};
    std::vector<Vec3> vertices;
    for (const double z : {0., 1.}) {
        for (const auto& [x, y] : outline) vertices.push_back(site.at({x, y, z}));
    }
    std::vector<std::vector<std::int64_t>> sides{{0, 1, 2, 3, 4, 5}, {11, 10, 9, 8, 7, 6}};
    for (std::int64_t i = 0; i < 6; ++i) sides.push_back({i, i + 6, (i + 1) % 6 + 6, (i + 1) % 6});
    draft.add_object("polygons", material).set("vertices", vectors(vertices)).set("faces", faces(sides));
}

void add_spots_of_box(Site& site) {
    for (const Side& side : sides_of(site.low, site.high)) {
        for (const double u : {0.21, 0.63}) {
            site.spots.push_back({side.corner + u * side.edge_u + (0.9 - u) * side.edge_v, normal_of(side)});
        }
    }
}

void add_environment(Draft& draft, Draw& draw) {
    draft.add_light("environment").set("luminance", number(draw.by_size(1, 1e4)));
}

Site draw_site(Draw& draw) {
    const double scale = std::array{draw.by_size(2, 12), draw.by_size(0.01, 1),
                                    draw.by_size(12, 1000)}[draw.weighted({8, 1, 2})];
    const Vec3 size{scale * draw.between(0.6, 1.6), scale * draw.between(0.6, 1.6),
                    scale * draw.between(0.3, 1)};
    Site site;
    switch (draw.weighted({6, 2, 2, 1})) {
        case 0:
            break;
        case 1:
            site.low = draw.inside({-100, -100, -10}, {100, 100, 10});
            break;
        case 2:
            site.low = {3.5e6 + draw.between(0, 1e4), 5.4e6 + draw.between(0, 1e4), 117};
            break;
        default:
            site.low = scale * draw.between(10, 1000) * draw.direction();
    }
    site.high = site.low + size;
    return site;
}

void add_two_rooms(Draft& draft, Draw& draw, Site& site, std::string& kind) {
    const std::string material = add_material(draft, draw);
    const double gap = draw.one_of({0.0, 0.1, 3.0}) * site.size().x;
    const Vec3 away{site.size().x + gap, 0, 0};
    kind = gap == 0 ? "two rooms with a door" : "two rooms";
    if (gap > 0) {
        for (const Vec3& shift : {Vec3{}, away}) {
            draft.add_object("box", material)
                .set("min", vector(site.low + shift))
                .set("max", vector(site.high + shift));
        }
    } else {
        const std::vector<Side> near = sides_of(site.low, site.high);
        const std::vector<Side> far = sides_of(site.low + away, site.high + away);
        for (const std::size_t i : {0, 1, 2, 4, 5}) add_rectangle(draft, near[i], material);
        for (const std::size_t i : {0, 1, 3, 4, 5}) add_rectangle(draft, far[i], material);
        add_with_hole(draft, near[3], 0.5 - draw.by_size(0.02, 0.4), 0.5 + draw.by_size(0.02, 0.4), material);
    }
    add_spots_of_box(site);
    // Its lamp, and a place to measure, are in the other room.
    const double size = site.least();
    draft.add_light("point")
        .set("position", vector(site.at({0.5, 0.5, 0.8}) + away))
        .set("flux", number(size * size * draw.by_size(1, 1e6)));
    draft.add_sensor("illuminance")
        .set("position", vector(site.at({0.3, 0.4, 0.3}) + away))
        .set("normal", vector({0, 0, 1}));
    site.is_closed = true;
}

void add_ground(Draft& draft, Draw& draw, Site& site) {
    const Vec3 edge{0.5 * (site.size().x + site.size().y) * draw.by_size(1, 300), 0, 0};
    const Vec3 other{0, edge.x, 0};
    const Vec3 middle = site.at({0.5, 0.5, 0});
    add_rectangle(draft, {middle - 0.5 * edge - 0.5 * other, edge, other}, add_material(draft, draw));
    site.spots.push_back({site.at({0.3, 0.6, 0}), {0, 0, 1}});
    site.spots.push_back({site.at({0.8, 0.2, 0}), {0, 0, 1}});
}

void add_sphere_room(Draft& draft, Draw& draw, Site& site) {
    const Vec3 middle = site.at({0.5, 0.5, 0.5});
    const double radius = 0.9 * site.least();
    draft.add_object("sphere", add_material(draft, draw))
        .set("center", vector(middle))
        .set("radius", number(radius));
    const double half = 0.5 * radius;
    site.low = middle - Vec3{half, half, half};
    site.high = middle + Vec3{half, half, half};
    for (int i = 0; i < 6; ++i) {
        const Vec3 d = draw.direction();
        site.spots.push_back({middle + radius * d, -d});
    }
}

}  // namespace

Site add_room(Draft& draft, Draw& draw, std::string& kind) {
    Site site = draw_site(draw);
    site.is_closed = true;
    const std::size_t chosen = draw.weighted({3, 3, 2, 2, 1, 2, 2, 2, 2, 1});
    if (chosen == 0) {
        kind = "box";
        draft.add_object("box", add_material(draft, draw))
            .set("min", vector(site.low))
            .set("max", vector(site.high));
        add_spots_of_box(site);
    } else if (chosen == 1) {
        kind = "six rectangles";
        for (const Side& side : sides_of(site.low, site.high))
            add_rectangle(draft, side, add_material(draft, draw));
        add_spots_of_box(site);
    } else if (chosen == 2) {
        kind = "mesh";
        add_mesh_room(draft, site, add_material(draft, draw));
        add_spots_of_box(site);
    } else if (chosen == 3) {
        kind = "L-shaped mesh";
        add_l_room(draft, site, add_material(draft, draw));
        site.spots = {{site.at({0.2, 0.3, 0}), {0, 0, 1}}, {site.at({0, 0.5, 0.4}), {1, 0, 0}}};
        site.high = site.at({0.5, 1, 1});
    } else if (chosen == 4) {
        kind = "sphere";
        add_sphere_room(draft, draw, site);
    } else if (chosen == 5) {
        add_two_rooms(draft, draw, site, kind);
    } else if (chosen == 6) {
        kind = "room with a window to the sky";
        const std::string material = add_material(draft, draw);
        const std::vector<Side> sides = sides_of(site.low, site.high);
        for (std::size_t i = 0; i < 5; ++i) add_rectangle(draft, sides[i], material);
        const double half = draw.by_size(0.02, 0.45);
        add_with_hole(draft, sides[5], 0.5 - half, 0.5 + half, material);
        add_environment(draft, draw);
        site.spots = {{site.at({0.3, 0.6, 0}), {0, 0, 1}}, {site.at({0, 0.4, 0.4}), {1, 0, 0}}};
        site.is_closed = false;
    } else if (chosen == 7) {
        kind = "ground";
        add_ground(draft, draw, site);
        if (draw.chance(0.4)) add_environment(draft, draw);
        site.is_closed = false;
    } else if (chosen == 8) {
        kind = "nothing";
        site.is_closed = false;
    } else {
        kind = "court open to the sky";
        const std::vector<Side> sides = sides_of(site.low, site.high);
        for (const std::size_t i : {0, 2, 3, 4, 5}) add_rectangle(draft, sides[i], add_material(draft, draw));
        add_environment(draft, draw);
        site.spots = {{site.at({0.3, 0.6, 0}), {0, 0, 1}}, {site.at({0, 0.4, 0.4}), {1, 0, 0}}};
        site.is_closed = false;
    }
    return site;
}

}  // namespace stilb::random
