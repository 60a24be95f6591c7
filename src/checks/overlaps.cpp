#include "scene/overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/vec.h"
#include "checks/checks.h"
#include "checks/walks.h"
#include "math/sampling.h"

namespace stilb::checks {
namespace {

/// The search ends after so many: the rest would not change what the user has to do.
constexpr std::size_t kMostOverlaps = 1000;

struct Found {
    std::size_t count = 0;
    Vec3 where;
};
/// By both objects.
using FoundOverlaps = std::map<std::pair<ObjectId, ObjectId>, Found>;

std::string lamp_text(const std::string& lamp, const std::string& other, const Found& found) {
    return fmt::format(
        "lamp \"{}\" lies in the plane of object \"{}\", at ({:.4g}, {:.4g}, {:.4g}): the lamp is taken, the "
        "wall behind it is hidden there. Move the lamp by a millimetre to say which one is in front.",
        lamp, other, found.where.x, found.where.y, found.where.z);
}

std::string text_of(const std::string& first, const std::string& second, const Found& found,
                    bool all_are_known) {
    const std::string named = first == second ? fmt::format("object \"{}\": parts of it", first)
                                              : fmt::format("objects \"{}\" and \"{}\"", first, second);
    return fmt::format(
        "{} overlap in one plane ({}{} pair{} of triangles, one at ({:.4g}, {:.4g}, {:.4g})): rounding "
        "decides "
        "which of them light meets. Move one of them by a millimetre.",
        named, all_are_known ? "" : "at least ", found.count, found.count == 1 ? "" : "s", found.where.x,
        found.where.y, found.where.z);
}

/// Whether anything is on that side: another surface, or a sensor. Below the ground that a house stands on
/// there is nothing, though light from infinity gets there. Without sensors all sides count.
bool is_looked_at(const Location& side, const rays::RayCaster& caster, std::span<const Sensor> sensors) {
    constexpr std::uint64_t rays = 16;
    constexpr std::size_t most_sensors = 64;
    if (sensors.empty()) return true;
    const Frame frame = Frame::around(side.normal);
    for (std::uint64_t i = 0; i < rays; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const auto [u1, u2] = stream.next_two();
        const Vec3 direction = frame.to_world(math::sample_cosine_hemisphere(u1, u2).direction);
        if (caster.closest(side.position, direction)) return true;
    }
    return std::ranges::any_of(sensors.first(std::min(sensors.size(), most_sensors)), [&](const Sensor& s) {
        const Vec3 at = s.camera() ? s.camera()->position : position_of(s.measurand(0));
        return dot(at - side.position, side.normal) > 0 && !caster.occluded(side.position, at);
    });
}

}  // namespace

std::vector<std::string> overlap_warnings(const Scene& scene, const rays::RayCaster& caster,
                                          const Enclosures& enclosures, std::span<const Sensor> sensors) {
    std::vector<bool> is_lamp(scene.objects.size());
    for (const Light& light : scene.lights) {
        if (const auto surface = lights::surface_emission(light)) is_lamp[index_of(surface->object)] = true;
    }
    const std::vector<Overlap> overlaps =
        scene::find_overlaps(scene, scene::OverlapsOf::all_surfaces, kMostOverlaps);
    const auto is_lamp_on = [&](const Overlap& overlap) {
        return is_lamp[index_of(overlap.first)] && !is_lamp[index_of(overlap.second)];
    };
    FoundOverlaps lamps_on, undecided;
    for (const Overlap& overlap : overlaps) {
        // Twice as far from the plane as a lamp that was put in front of it.
        const Vec3 off = 4 * caster.offset_m(overlap.position, caster.half_extent_m()) * overlap.normal;
        const auto is_lit = [&](const Vec3& side) {
            const Location place{overlap.position + side, normalized(side)};
            const Enclosure enclosure = enclosures.enclosure_of({place.position, place.normal});
            return enclosures.is_lit(enclosure) &&
                   (!enclosure.empty() || is_looked_at(place, caster, sensors));
        };
        // Of lamps only the fronts count: behind them the other surface is hidden anyway.
        if (!is_lit(off) && (is_lamp_on(overlap) || !is_lit(-off))) continue;
        Found& found = (is_lamp_on(overlap) ? lamps_on : undecided)[{overlap.first, overlap.second}];
        if (found.count++ == 0) found.where = overlap.position;
    }
    std::vector<std::string> warnings;
    const auto name_of = [&](ObjectId object) { return scene.object(object).name; };
    for (const auto& [pair, found] : lamps_on)
        warnings.push_back(lamp_text(name_of(pair.first), name_of(pair.second), found));
    for (const auto& [pair, found] : undecided) {
        warnings.push_back(
            text_of(name_of(pair.first), name_of(pair.second), found, overlaps.size() < kMostOverlaps));
    }
    return warnings;
}

}  // namespace stilb::checks
