// Lamps that were probably not meant: the same one twice, or a whole room of which a part should shine.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "checks/checks.h"
#include "checks/walks.h"
#include "math/sampling.h"

namespace stilb::checks {
namespace {

// The same lamp twice.

/// The middle in whole millimetres.
std::array<long long, 3> millimetres(const Vec3& middle) {
    return {std::llround(1e3 * middle.x), std::llround(1e3 * middle.y), std::llround(1e3 * middle.z)};
}

/// Whether both colours are the same, whatever the flux: lamps of two colours in one place are one of tunable
/// white.
bool have_one_colour(const Rgb& a, const Rgb& b) {
    constexpr double same = 1e-3;
    const Rgb difference = a * (1 / a.luminance()) + -1 * (b * (1 / b.luminance()));
    return std::max({std::abs(difference[0]), std::abs(difference[1]), std::abs(difference[2])}) < same;
}

/// Whether two lamps give the same light; those with surfaces other than openings of luminaires, if these are
/// nowhere farther apart than `tolerance_m`.
bool have_one_distribution(const Light& a, const Light& b, const Scene& scene, double tolerance_m) {
    if (!lights::shine_alike(a, b)) return false;
    const auto surface = lights::emitting_object(a), other = lights::emitting_object(b);
    if (surface && !lights::luminaire_of(a) &&
        !coincide(scene.object(*surface).shape, scene.object(*other).shape, tolerance_m))
        return false;
    return have_one_colour(flux_lm(scene, a), flux_lm(scene, b));
}

/// The names of lights, in the order of the scene, of which each is like the first.
using Alike = std::vector<std::string>;

/// The lights of one place that are alike, where there are several.
std::vector<Alike> alike_among(const std::vector<const Light*>& in_one_place, const Scene& scene,
                               double tolerance_m) {
    std::vector<std::pair<const Light*, Alike>> kinds;
    for (const Light* light : in_one_place) {
        const auto kind = std::ranges::find_if(kinds, [&](const auto& known) {
            return have_one_distribution(*known.first, *light, scene, tolerance_m);
        });
        if (kind == kinds.end()) {
            kinds.push_back({light, {light->name}});
        } else {
            kind->second.push_back(light->name);
        }
    }
    std::vector<Alike> several;
    for (auto& [light, names] : kinds) {
        if (names.size() > 1) several.push_back(std::move(names));
    }
    return several;
}

std::vector<std::string> duplicate_warnings(const Scene& scene, const rays::RayCaster& caster) {
    std::map<std::array<long long, 3>, std::vector<const Light*>> by_place;
    for (const Light& light : scene.lights) {
        if (const auto middle = place_of(scene, light)) by_place[millimetres(*middle)].push_back(&light);
    }
    std::string first;
    std::size_t more = 0;
    for (const auto& [place, in_one_place] : by_place) {
        const auto [x, y, z] = place;
        const Vec3 middle{1e-3 * static_cast<double>(x), 1e-3 * static_cast<double>(y),
                          1e-3 * static_cast<double>(z)};
        for (const Alike& names : alike_among(in_one_place, scene, caster.offset_m(middle, 0))) {
            if (!first.empty()) {
                ++more;
                continue;
            }
            first = fmt::format("lights {} are alike and in one place, ({:g}, {:g}, {:g})", list_of(names),
                                middle.x, middle.y, middle.z);
        }
    }
    if (first.empty()) return {};
    if (more > 0) first += fmt::format(", and so are lights in {} more place{}", more, more == 1 ? "" : "s");
    return {first + ": their light adds up. Remove all but one."};
}

// A whole object as a lamp.

constexpr std::size_t kMostSensors = 64, kMostLamps = 64;

/// Whether most rays in all directions from a point meet the object first.
bool surrounds(ObjectId object, const Vec3& point, const rays::RayCaster& caster) {
    constexpr std::uint64_t rays = 64;
    std::uint64_t met = 0;
    for (std::uint64_t i = 0; i < rays; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const auto [u1, u2] = stream.next_two();
        const auto hit = caster.closest(point, math::sample_sphere(u1, u2).direction);
        met += hit && hit->object == object;
    }
    return 2 * met > rays;
}

/// The names of the sensors whose first point lies inside of the object.
std::vector<std::string> surrounded(std::span<const Sensor> sensors, ObjectId object,
                                    const rays::RayCaster& caster) {
    std::vector<std::string> names;
    for (const Sensor& sensor : sensors.first(std::min(sensors.size(), kMostSensors))) {
        if (surrounds(object, first_point_of(sensor, caster).lifted, caster)) names.push_back(sensor.name);
    }
    return names;
}

/// Luminous spheres and smooth bodies are meant to shine all over; of meshes and boxes that is less likely.
bool may_be_a_mistake(const Object& object) {
    return !object.cut_from &&
           (geometry::stored_mesh(object.shape) != nullptr || std::holds_alternative<Box>(object.shape));
}

/// " of a closed surface, all around sensor "desk"".
std::string described(bool is_closed, const std::vector<std::string>& sensors) {
    std::string text = is_closed ? " of a closed surface" : "";
    if (!sensors.empty())
        text +=
            fmt::format(", all around {} {}", sensors.size() == 1 ? "sensor" : "sensors", list_of(sensors));
    return text;
}

std::vector<std::string> whole_lamp_warnings(const Scene& scene, const rays::RayCaster& caster,
                                             const std::vector<geometry::ConnectedComponents>& components,
                                             std::span<const Sensor> sensors) {
    std::string first;
    std::vector<std::string> others;
    std::size_t tested = 0;
    for (const Light& light : scene.lights) {
        const auto surface = lights::uniform_emission(light);
        if (!surface || !may_be_a_mistake(scene.object(surface->object))) continue;
        const Object& object = scene.object(surface->object);
        const bool is_closed = components[index_of(surface->object)].total_open_edges() == 0;
        const auto inside =
            tested++ < kMostLamps ? surrounded(sensors, surface->object, caster) : std::vector<std::string>{};
        if (!is_closed && inside.empty()) continue;
        if (!first.empty()) {
            others.push_back(light.name);
            continue;
        }
        first = fmt::format("light \"{}\": the whole of object \"{}\" shines, {:.4g} m2{}", light.name,
                            object.name, area_m2(object.shape), described(is_closed, inside));
    }
    if (first.empty()) return {};
    if (!others.empty()) first += fmt::format("; likewise {}", list_of(others));
    return {first +
            ". If only some of its faces are the lamp, pick them by material or mesh_group, or make them an "
            "object of their own."};
}

}  // namespace

std::vector<std::string> lamp_warnings(const Scene& scene, const rays::RayCaster& caster,
                                       const std::vector<geometry::ConnectedComponents>& components,
                                       std::span<const Sensor> sensors) {
    std::vector<std::string> warnings = duplicate_warnings(scene, caster);
    for (std::string& warning : whole_lamp_warnings(scene, caster, components, sensors))
        warnings.push_back(std::move(warning));
    return warnings;
}

}  // namespace stilb::checks
