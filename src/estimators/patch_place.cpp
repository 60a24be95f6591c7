#include "estimators/patch_place.h"

#include <algorithm>
#include <limits>

namespace stilb {
namespace {

/// Of the point of a patch nearest to `point`, along the normal; drawn into the patch.
Barycentric barycentric_of(const Patches& patches, std::uint32_t patch, const Vec3& point) {
    const auto& [a, b, c] = patches.corners[patch];
    const Vec3 corner(patches.vertices[a]), normal(patches.normals[patch]);
    const Vec3 ab = Vec3(patches.vertices[b]) - corner, ac = Vec3(patches.vertices[c]) - corner;
    const Vec3 ap = point - patches.center - corner;
    const double doubled = dot(cross(ab, ac), normal);
    const double b1 = std::clamp(dot(cross(ap, ac), normal) / doubled, 0.0, 1.0);
    const double b2 = std::clamp(dot(cross(ab, ap), normal) / doubled, 0.0, 1 - b1);
    return {1 - b1 - b2, b1, b2};
}

}  // namespace

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
    const std::uint32_t side = caster.closest(packet, lanes)[0];
    if (side == kNoSide) return std::nullopt;
    const Vec3 met = origin - double{packet.end[0]} * outgoing + patches.center;
    return PatchPlace{side, barycentric_of(patches, patches.patch_of(side), met)};
}

}  // namespace stilb
