// Scenes whose readings are known: direct light of lamps in the open, the furnace, the photometric sphere and
// an even sky. Everything is computed here, from exact/ or by quadrature.
#include <fmt/format.h>

#include <functional>

#include "exact/closed_rooms.h"
#include "exact/configuration_factors.h"
#include "random/generator.h"
#include "random/photometry.h"

namespace stilb::random {
namespace {

constexpr double kGreyLuminance = 100;

/// The illuminance at a point by one lamp.
using LampLight = std::function<double(const exact::Receiver&)>;

using Intensity = double (*)(double gamma_deg, double c_deg);

/// Flux of a file in lm: by its intensities between their steps.
double flux_of(Intensity intensity_cd) {
    constexpr int kGammas = 9000, kPlanes = 720;
    double flux = 0;
    for (int c = 0; c < kPlanes; ++c) {
        const double c_deg = (c + 0.5) * 360 / kPlanes;
        for (int g = 0; g < kGammas; ++g) {
            const double gamma = (g + 0.5) * 90 / kGammas;
            flux += between_steps_cd(intensity_cd, gamma, c_deg) * std::sin(gamma * kPi / 180);
        }
    }
    return flux * (kPi / 2 / kGammas) * (2 * kPi / kPlanes);
}

/// An opening that hangs straight down: each element sends the file's distribution, its share by area.
LampLight opening_light(Intensity intensity_cd, const Vec3& position, double along_x, double along_y,
                        double spin_deg, double flux) {
    static const double cosine_flux = flux_of(cosine_cd), washer_flux = flux_of(washer_cd),
                        beam_flux = flux_of(beam_cd);
    const double of_file = intensity_cd == cosine_cd   ? cosine_flux
                           : intensity_cd == washer_cd ? washer_flux
                                                       : beam_flux;
    return [=](const exact::Receiver& at) {
        const double spin = spin_deg * kPi / 180;
        const Vec3 c0{std::cos(spin), std::sin(spin), 0}, c90{-std::sin(spin), std::cos(spin), 0};
        const int count = along_x > 0 ? 40 : 1;
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < count; ++j) {
                const double u = (i + 0.5) / count - 0.5, v = (j + 0.5) / count - 0.5;
                const Vec3 away = at.position - (position + u * along_x * c0 + v * along_y * c90);
                const double distance = length(away), cosine = -dot(at.normal, away) / distance;
                if (away.z >= 0 || cosine <= 0) continue;
                const double gamma = std::acos(std::min(1.0, -away.z / distance)) * 180 / kPi;
                double c = std::atan2(dot(away, c90), dot(away, c0)) * 180 / kPi;
                if (c < 0) c += 360;
                sum += between_steps_cd(intensity_cd, gamma, c) * cosine / (distance * distance);
            }
        }
        return sum / (count * count) * flux / of_file;
    };
}

/// Flat lamps and points in one level plane, all of which shine straight down: none shades another.
LampLight add_lamp(Draft& draft, Draw& draw, std::size_t kind, const Vec3& at, double half, double flux) {
    const double along_x = 2 * half, along_y = 2 * half * draw.between(0.3, 1);
    const double spin = draw.chance(0.5) ? 0 : draw.between(-180, 180);
    const auto photometry = [&](const char* file, Intensity intensity_cd, bool is_point) {
        draft.add_light("photometry")
            .set("file", text(file))
            .set("position", vector(at))
            .set("flux", number(flux))
            .set("spin", number(spin))
            .set("opening",
                 is_point ? text("point") : TomlValue{TomlArray{number(along_y), number(along_x)}});
        return opening_light(intensity_cd, at, is_point ? 0 : along_x, is_point ? 0 : along_y, spin, flux);
    };
    const auto add_area = [&](const Part& object) {
        const std::string name = object.name;
        draft.add_light("area").set("object", text(name)).set("flux", number(flux));
    };
    switch (kind) {
        case 0:
            draft.add_light("point").set("position", vector(at)).set("flux", number(flux));
            return [=](const exact::Receiver& to) {
                return exact::illuminance_by_point_lx(to, at, flux / (4 * kPi));
            };
        case 1: {
            const Vec3 corner = at - Vec3{half, 0.5 * along_y, 0}, u{0, along_y, 0}, v{along_x, 0, 0};
            add_area(draft.add_object("rectangle", draft.add_material("black").name)
                         .set("corner", vector(corner))
                         .set("edge_u", vector(u))
                         .set("edge_v", vector(v)));
            return [=](const exact::Receiver& to) {
                return exact::illuminance_by_rectangle_lx(to, corner, u, v, flux / (kPi * along_x * along_y));
            };
        }
        case 2:
            add_area(draft.add_object("disk", draft.add_material("black").name)
                         .set("center", vector(at))
                         .set("normal", vector({0, 0, -1}))
                         .set("radius", number(half)));
            return [=](const exact::Receiver& to) {
                return exact::illuminance_by_disk_lx(to, {at, {0, 0, -1}, half},
                                                     flux / (kPi * kPi * half * half));
            };
        case 3:
            return photometry(kBeamFile, beam_cd, true);
        case 4:
            return photometry(kCosineFile, cosine_cd, false);
        default:
            return photometry(kWasherFile, washer_cd, false);
    }
}

void add_direct(RandomScene& random, Draw& draw) {
    Draft& draft = random.draft;
    const double scale = draw.by_size(0.1, 30);
    const Vec3 origin = draw.chance(0.5) ? Vec3{} : Vec3{3.5e6, 5.4e6, 100};
    const auto count = draw.one_of<std::size_t>({1, 1, 2, 16, 17, 32, 33, 34, 65});
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const bool mixes = draw.chance(0.5);
    const std::size_t first = draw.below(6);
    std::vector<LampLight> lamps;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 at =
            origin + scale * Vec3{static_cast<double>(i % columns), static_cast<double>(i / columns), 0};
        lamps.push_back(add_lamp(draft, draw, mixes ? draw.below(6) : first, at,
                                 0.45 * scale * draw.by_size(0.05, 1), 1000));
    }
    const double across = scale * static_cast<double>(columns);
    for (std::size_t i = draw.one_of<std::size_t>({1, 2, 4}); i > 0; --i) {
        exact::Receiver to;
        const double below = scale * draw.by_size(1, 100);
        to.position = origin + Vec3{draw.between(-1, 1) * (across + below),
                                    draw.between(-1, 1) * (across + below), -below};
        to.normal =
            draw.chance(0.5) ? Vec3{0, 0, 1} : normalized(Vec3{draw.between(-1, 1), draw.between(-1, 1), 1});
        draft.add_sensor("illuminance").set("position", vector(to.position)).set("normal", vector(to.normal));
        double sum = 0;
        for (const LampLight& lamp : lamps) sum += lamp(to);
        random.exact.push_back(sum);
    }
    random.kind = fmt::format("exact: {} lamps in the open", count);
}

void add_furnace(RandomScene& random, Draw& draw) {
    Draft& draft = random.draft;
    const double reflectance = draw.between(0.1, 0.9), scale = draw.by_size(0.1, 100);
    const Vec3 low = draw.chance(0.5) ? Vec3{} : Vec3{3.5e6, 5.4e6, 100};
    const Vec3 size = scale * Vec3{1, draw.between(0.3, 1), draw.between(0.3, 1)};
    const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    const std::string material = add_plain_material(draft, reflectance);
    for (const auto& [corner, u, v] : {std::array{low, x, y},
                                       {low + z, y, x},
                                       {low, y, z},
                                       {low + x, z, y},
                                       {low, z, x},
                                       {low + y, x, z}}) {
        const std::string name = draft.add_object("rectangle", material)
                                     .set("corner", vector(corner))
                                     .set("edge_u", vector(u))
                                     .set("edge_v", vector(v))
                                     .name;
        draft.add_light("area").set("object", text(name)).set("luminance", number(kGreyLuminance));
    }
    for (std::size_t i = draw.one_of<std::size_t>({1, 2, 3}); i > 0; --i) {
        draft.add_sensor("illuminance")
            .set("position", vector(draw.inside(low + 0.01 * size, low + 0.99 * size)))
            .set("normal", vector(draw.direction()));
        random.exact.push_back(exact::furnace_illuminance_lx(kGreyLuminance, reflectance));
    }
    random.kind = "exact: furnace";
}

void add_sphere(RandomScene& random, Draw& draw) {
    Draft& draft = random.draft;
    const exact::PhotometricSphere sphere{draw.by_size(0.01, 100), draw.between(0.1, 0.9)};
    const Vec3 center = draw.chance(0.5) ? Vec3{} : Vec3{3.5e6, 5.4e6, 100};
    draft.add_object("sphere", add_plain_material(draft, sphere.reflectance))
        .set("center", vector(center))
        .set("radius", number(sphere.radius_m));
    const auto count = draw.one_of<std::size_t>({1, 2, 17, 33});
    std::vector<Vec3> sources;
    for (std::size_t i = 0; i < count; ++i) {
        sources.push_back(sphere.radius_m * draw.between(0, 0.8) * draw.direction());
        draft.add_light("point").set("position", vector(center + sources.back())).set("flux", number(1000));
    }
    for (std::size_t i = draw.one_of<std::size_t>({1, 2, 3}); i > 0; --i) {
        const Vec3 to_wall = draw.direction();
        draft.add_sensor("illuminance")
            .set("position", vector(center + sphere.radius_m * to_wall))
            .set("normal", vector(-to_wall));
        double sum = 0;
        for (const Vec3& source : sources) sum += exact::illuminance_lx(sphere, 1000, source, to_wall);
        random.exact.push_back(sum);
    }
    random.kind = fmt::format("exact: photometric sphere, {} points", count);
}

/// Two lamps of one kind in one place above a black floor: seen and felt alike.
void add_twins(RandomScene& random, Draw& draw) {
    Draft& draft = random.draft;
    const double size = draw.by_size(0.1, 10), half = size * draw.between(0.05, 0.2), flux = 1000;
    const Vec3 origin = draw.chance(0.5) ? Vec3{} : Vec3{3.5e6, 5.4e6, 100};
    draft.add_object("rectangle", draft.add_material("black").name)
        .set("corner", vector(origin - size * Vec3{2, 2, 0}))
        .set("edge_u", vector(size * Vec3{4, 0, 0}))
        .set("edge_v", vector(size * Vec3{0, 4, 0}));
    const Vec3 lamp = origin + Vec3{0, 0, size};
    const std::size_t kind = draw.one_of<std::size_t>({1, 2, 4});
    LampLight light;
    const Draw same = draw;
    for (int i = 0; i < 2; ++i) {
        draw = same;
        light = add_lamp(draft, draw, kind, lamp, half, flux);
    }
    const Vec3 position = origin + Vec3{0.4 * size, 0.3 * size, 0.1 * size};
    draft.add_sensor("illuminance").set("position", vector(position)).set("normal", vector({0, 0, 1}));
    draft.add_sensor("luminance").set("position", vector(position)).set("target", vector(lamp));
    const Part& last = draft.lights.back();
    double area = kPi * half * half;
    if (const Part* const object = draft.object(last.text("object")); object && object->find("edge_u"))
        area = length(cross(object->vector("edge_u"), object->vector("edge_v")));
    if (const TomlValue* const opening = last.find("opening")) {
        const auto& sides = std::get<TomlArray>(opening->content);
        area = as_number(sides[0]) * as_number(sides[1]);
    }
    random.exact = {light({position, {0, 0, 1}}), flux / (kPi * area)};
    random.may_be_twice = true;
    random.kind = "exact: lamp twice";
}

void add_sky(RandomScene& random, Draw& draw) {
    random.draft.add_light("environment").set("luminance", number(kGreyLuminance));
    random.draft.add_sensor("illuminance")
        .set("position", vector(draw.by_size(1, 1e7) * draw.direction()))
        .set("normal", vector(draw.direction()));
    random.exact = {kPi * kGreyLuminance};
    random.kind = "exact: sky alone";
}

}  // namespace

RandomScene generate_exact(Draw& draw) {
    RandomScene random;
    switch (draw.weighted({5, 1, 1, 1, 0.3})) {
        case 0:
            add_direct(random, draw);
            break;
        case 1:
            add_furnace(random, draw);
            break;
        case 2:
            add_sphere(random, draw);
            break;
        case 3:
            add_twins(random, draw);
            break;
        default:
            add_sky(random, draw);
    }
    return random;
}

}  // namespace stilb::random
