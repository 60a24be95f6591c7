#include "transport/entries.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "materials/material.h"
#include "math/random.h"
#include "math/sampling.h"

namespace stilb::transport {
namespace {

/// Walks end when they have found enough places; in the open most of them leave the scene at once.
constexpr std::uint64_t kMostWalks = 4096;
constexpr std::size_t kPlaces = 768;
constexpr int kReflections = 3;
/// Places are in groups where so much of their longest extent is between them.
constexpr double kApart = 1.0 / 8;
/// A part of a box has so much less surface, and so many places at least. The box keeps the rest of its
/// particles beside this share of them.
constexpr double kMuchLess = 8, kShareOfParts = 0.75;
constexpr std::size_t kLeastPlaces = 8;
/// Rays that come from so far away are rounded by less than this share of the way.
constexpr double kRounding = 0x1p-20;

/// Surfaces that reflect light towards the measured points, in proportion to their reflectance.
std::vector<Vec3> seen_places(const rays::RayCaster& caster) {
    const std::span<const Vec3> measured = caster.measured();
    std::vector<Vec3> places;
    if (measured.empty()) return places;
    for (std::uint64_t walk = 0; walk < kMostWalks && places.size() < kPlaces; ++walk) {
        math::SampleStream stream(math::RandomKey{}, walk);
        const double u = stream.next() * static_cast<double>(measured.size());
        Vec3 origin = measured[static_cast<std::size_t>(u)];
        const auto [u1, u2] = stream.next_two();
        Vec3 direction = math::sample_sphere(u1, u2).direction;
        for (int reflection = 0; reflection < kReflections; ++reflection) {
            const auto hit = caster.closest(origin, direction);
            if (!hit) break;
            const Material& material = caster.scene().material(hit->material);
            if (stream.next() >= reflectance_bound(material).max()) break;
            places.push_back(hit->position);
            const auto [v1, v2] = stream.next_two();
            if (transmits(material) && stream.next() < 0.5) {
                origin = hit->lifted_behind();
                continue;
            }
            origin = hit->lifted;
            direction = Frame::around(hit->normal).to_world(math::sample_cosine_hemisphere(v1, v2).direction);
        }
    }
    return places;
}

/// Calls `visit` for the groups of places that are so far apart; reorders them.
template <typename Visit>
void visit_groups(std::span<Vec3> places, double apart_m, const Visit& visit) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::ranges::sort(places, {}, [axis](const Vec3& place) { return place[axis]; });
        for (std::size_t i = 1; i < places.size(); ++i) {
            if (places[i][axis] - places[i - 1][axis] <= apart_m) continue;
            visit_groups(places.first(i), apart_m, visit);
            visit_groups(places.subspan(i), apart_m, visit);
            return;
        }
    }
    visit(places);
}

/// A part of a box, with room beside its places for what the walks have not met.
Bounds part_around(const Bounds& places, const Bounds& box, double least_room_m) {
    const double room_m = std::max(places.half_extent() / 2, least_room_m);
    const Vec3 room{room_m, room_m, room_m}, low = places.min - room, high = places.max + room;
    return {{std::max(low.x, box.min.x), std::max(low.y, box.min.y), std::max(low.z, box.min.z)},
            {std::min(high.x, box.max.x), std::min(high.y, box.max.y), std::min(high.z, box.max.z)}};
}

struct Finder {
    double least_room_m = 0;
    std::vector<lights::Entry> entries;

    /// Adds the part of a box around places, if it is one, and parts of it or of the box around groups of
    /// them. Returns how much they take of the share of particles that these places may have.
    double add(std::span<Vec3> places, const Bounds& box, double share) {
        if (places.size() < kLeastPlaces) return 0;
        Bounds extent;
        for (const Vec3& place : places) extent.include(place);
        const Bounds part = part_around(extent, box, least_room_m);
        const bool is_part = kMuchLess * part.surface_m2() < box.surface_m2();
        const std::size_t own = entries.size();
        if (is_part) entries.push_back({part});
        const double of_groups = is_part ? kShareOfParts * share : share;
        double taken = 0;
        visit_groups(places, 2 * kApart * extent.half_extent(), [&](std::span<Vec3> group) {
            if (group.size() == places.size()) return;
            taken += add(group, is_part ? part : box,
                         of_groups * static_cast<double>(group.size()) / static_cast<double>(places.size()));
        });
        if (!is_part) return taken;
        entries[own].share = share - taken;
        return share;
    }
};

}  // namespace

std::vector<lights::Entry> entries_to(const rays::RayCaster& caster) {
    std::vector<Vec3> places = seen_places(caster);
    const Bounds box = bounds_of(caster.scene());
    Finder finder{kRounding * box.half_extent(), {}};
    finder.add(places, box, kShareOfParts);
    return std::move(finder.entries);
}

}  // namespace stilb::transport
