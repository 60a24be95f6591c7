#include "estimators/patch_light/patch_location.h"

#include <algorithm>
#include <limits>

namespace stilb::estimators {

std::vector<std::optional<PatchLocation>> find_patch_locations(const patches::PatchCaster& caster,
                                                               std::span<const ViewedHit> points,
                                                               rays::Coherence coherence) {
    // The way to the hit is free. So is a short stretch of it, from where patches that bulge out of the true
    // surface by rounding are met.
    constexpr double stretch = 1e-3;
    std::vector<std::optional<PatchLocation>> places(points.size());
    for (std::size_t first = 0; first < points.size(); first += kPacketWidth) {
        const std::size_t count = std::min<std::size_t>(kPacketWidth, points.size() - first);
        RayPacket packet;
        LaneMask lanes{};
        for (std::size_t lane = 0; lane < count; ++lane) {
            const auto& [hit, outgoing] = points[first + lane];
            packet.set(lane, hit.position + (stretch * hit.distance_m) * outgoing - caster.patches().center,
                       -outgoing, std::numeric_limits<float>::infinity());
            lanes[lane] = -1;
        }
        const patches::PatchHits hits = caster.closest(packet, lanes, coherence);
        for (std::size_t lane = 0; lane < count; ++lane) {
            if (hits.sides[lane] == patches::kNoSide) continue;
            places[first + lane] = PatchLocation{hits.sides[lane], hits.place(lane)};
        }
    }
    return places;
}

}  // namespace stilb::estimators
