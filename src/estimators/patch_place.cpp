#include "estimators/patch_place.h"

#include <limits>

namespace stilb {
std::optional<PatchPlace> find_place(const PatchCaster& caster, const Hit& hit, const Vec3& outgoing) {
    // The way to the hit is free. So is a short stretch of it, from where patches that bulge out of the true
    // surface by rounding are met.
    constexpr double stretch = 1e-3;
    const Patches& patches = caster.patches();
    const Vec3 origin = hit.position + (stretch * hit.distance_m) * outgoing - patches.center;
    RayPacket packet;
    LaneMask lanes{};
    lanes[0] = -1;
    packet.set(0, origin, -outgoing, std::numeric_limits<float>::infinity());
    const PatchHits hits = caster.closest(packet, lanes);
    if (hits.sides[0] == kNoSide) return std::nullopt;
    return PatchPlace{hits.sides[0], hits.place(0)};
}

}  // namespace stilb
