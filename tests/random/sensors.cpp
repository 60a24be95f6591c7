// Sensors of random scenes: of all types, near surfaces, on them, inside and outside of everything.
#include "random/generator.h"

namespace stilb::random {
namespace {

Vec3 draw_position(Draw& draw, const Site& site) {
    const Vec3 middle = site.at({0.5, 0.5, 0.5});
    switch (draw.weighted({10, 1, 1, site.is_closed ? 0. : 2.})) {
        case 0:
            return draw.inside(site.at({0.05, 0.05, 0.02}), site.at({0.95, 0.95, 0.85}));
        case 1:
            return middle + 2 * site.least() * draw.direction();
        case 2:
            return draw.inside(site.low, site.high);
        default:
            return middle + draw.by_size(1, 300) * site.least() * draw.direction();
    }
}

Vec3 draw_normal(Draw& draw) { return draw.chance(0.6) ? Vec3{0, 0, 1} : draw.direction(); }

Vec3 draw_level_direction(Draw& draw) {
    const double phi = draw.between(0, 2 * kPi);
    return {std::cos(phi), std::sin(phi), 0};
}

/// On a surface, or close above it.
Spot draw_near_surface(Draw& draw, const Site& site) {
    if (site.spots.empty()) return {draw_position(draw, site), draw_normal(draw)};
    Spot spot = site.spots[draw.below(site.spots.size())];
    spot.position += draw.one_of({0.0, 1e-6, 1e-4, 1e-3, 1e-2}) * site.least() * spot.normal;
    return spot;
}

void set_positions(Part& sensor, Draw& draw, const Site& site) {
    std::vector<Vec3> positions;
    for (std::size_t i = draw.one_of<std::size_t>({1, 1, 2, 3}); i > 0; --i)
        positions.push_back(draw_position(draw, site));
    if (positions.size() == 1)
        sensor.set("position", vector(positions[0]));
    else
        sensor.set("positions", vectors(positions));
}

void add_grid(Draft& draft, Draw& draw, const Site& site, std::int64_t across, std::int64_t along) {
    draft.add_sensor("grid")
        .set("corner", vector(site.at({0.12, 0.13, draw.between(0.02, 0.5)})))
        .set("edge_u", vector({0.7 * site.size().x, 0, 0}))
        .set("edge_v", vector({0, 0.7 * site.size().y, 0}))
        .set("normal", vector({0, 0, draw.chance(0.9) ? 1. : -1.}))
        .set("count", {TomlArray{{across}, {along}}});
}

/// A few points, of which those in furniture are left out.
void add_area(Draft& draft, Draw& draw, const Site& site) {
    draft.add_sensor("area")
        .set("corner", vector(site.at({0.2, 0.3, draw.between(0.1, 0.5)})))
        .set("edge_u", vector({0.5 * site.size().x, 0, 0}))
        .set("edge_v", vector({0, 0.4 * site.size().y, 0}))
        .set("spacing", number(std::max(0.001, 0.3 * site.size().x)));
}

void add_camera(Draft& draft, Draw& draw, const Site& site) {
    const Vec3 eye = draw.inside(site.at({0.1, 0.1, 0.2}), site.at({0.9, 0.9, 0.8}));
    draft.add_sensor("camera")
        .set("position", vector(eye))
        .set("target", vector(eye + site.least() * draw.direction()))
        .set("fov", number(draw.between(30, 100)))
        .set("resolution", integers({9, 7}));
}

void add_sensor(Draft& draft, Draw& draw, const Site& site) {
    const std::size_t kind =
        draw.weighted({5, 3, 1, 1, 1, 1, 2, 2, 0.5, 0.5, 0.3, site.spots.empty() ? 0. : 1.});
    switch (kind) {
        case 0:
            set_positions(draft.add_sensor("illuminance").set("normal", vector(draw_normal(draw))), draw,
                          site);
            break;
        case 1: {
            const Spot spot = draw_near_surface(draw, site);
            draft.add_sensor("illuminance")
                .set("position", vector(spot.position))
                .set("normal", vector(spot.normal));
            break;
        }
        case 2:
            set_positions(draft.add_sensor("cylindrical"), draw, site);
            break;
        case 3:
            set_positions(
                draft.add_sensor("semicylindrical").set("direction", vector(draw_level_direction(draw))),
                draw, site);
            break;
        case 4:
            set_positions(draft.add_sensor("hemispherical").set("normal", vector(draw_normal(draw))), draw,
                          site);
            break;
        case 5:
            set_positions(draft.add_sensor("spherical"), draw, site);
            break;
        case 6:
            add_grid(draft, draw, site, draw.one_of<std::int64_t>({1, 2}), 2);
            break;
        case 7: {
            draft.add_sensor("luminance")
                .set("position", vector(draw_position(draw, site)))
                .set("direction", vector(draw.direction()));
            break;
        }
        case 8:
            draft.add_sensor("ugr")
                .set("position", vector(draw_position(draw, site)))
                .set("direction", vector(draw_level_direction(draw)));
            break;
        case 9:
            add_area(draft, draw, site);
            break;
        case 10:
            add_camera(draft, draw, site);
            break;
        default: {
            const Spot& spot = site.spots[draw.below(site.spots.size())];
            draft.add_sensor("goniometer")
                .set("point", vector(spot.position))
                .set("normal", vector(spot.normal))
                .set("plane", number(draw.between(0, 180)))
                .set("step", number(45));
        }
    }
}

}  // namespace

void add_sensors(Draft& draft, Draw& draw, const Site& site) {
    for (std::size_t i = draw.one_of<std::size_t>({1, 2, 3, 4}); i > 0; --i) add_sensor(draft, draw, site);
    // With more than 64 readings `auto` chooses among other techniques; packets have 16 of them.
    if (draw.chance(0.12)) {
        const auto [across, along] = draw.one_of<std::array<std::int64_t, 2>>(
            {{15, 1}, {16, 1}, {17, 1}, {9, 7}, {8, 8}, {13, 5}, {12, 12}});
        add_grid(draft, draw, site, across, along);
    }
}

}  // namespace stilb::random
