#include "estimators/patch_light/solution/contact_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/sampling.h"
#include "transport/receiver.h"

namespace stilb::estimators {
namespace {

/// No edge of a finer patch has to be shorter than this share of the edges of the walks' patches.
constexpr double kLeastShareOfSize = 1. / 5;

/// The mean over all sides that are lit, by area.
double mean_lx(const PatchTransport& coarse, const SideLight& light) {
    double flux_lm = 0, area_m2 = 0;
    for (std::uint32_t side = 0; side < light.lx.size(); ++side) {
        if (!(light.lx[side] > 0)) continue;
        const double of_patch_m2 = coarse.patches.areas_m2[coarse.patches.patch_of(side)];
        flux_lm += of_patch_m2 * light.lx[side];
        area_m2 += of_patch_m2;
    }
    return area_m2 > 0 ? flux_lm / area_m2 : 0;
}

/// The harmonic mean of the distances of the surfaces that a place sees [m]; infinite in a gap that is too
/// narrow for the finest patches to show how the light decreases in it.
double distance_around_m(const PatchTransport& coarse, std::uint32_t side, const Vec3& position) {
    const Vec3 lifted = lifted_off(coarse.scene, coarse.patches, coarse.caster, side, position);
    const Frame frame = Frame::around(coarse.patches.normal_of(side));
    RayPacket packet;
    LaneMask lanes{};
    for (std::uint32_t i = 0; i < kPacketWidth; ++i) {
        packet.set(i, lifted - coarse.patches.center, frame.to_world(math::cosine_direction(i, kPacketWidth)),
                   std::numeric_limits<float>::infinity());
        lanes[i] = -1;
    }
    coarse.patch_caster.closest(packet, lanes);
    const auto farthest_m = double{*std::ranges::max_element(packet.end)};
    if (farthest_m < kLeastShareOfSize * coarse.size_m) return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (const float distance_m : packet.end) sum += 1 / double{distance_m};
    return kPacketWidth / sum;
}

/// The same for a part of a patch, in its middle. Where the middle lies in a narrow gap, places near the
/// corners count, too: a part that reaches out of the gap must be divided, so that it shows where the gap
/// ends.
double distance_around_m(const PatchTransport& coarse, std::uint32_t side,
                         const std::array<Vec3, 3>& corners) {
    constexpr double share_to_middle = 0.1;
    const Vec3 middle = (1. / 3) * (corners[0] + corners[1] + corners[2]);
    double distance_m = distance_around_m(coarse, side, middle);
    if (std::isfinite(distance_m)) return distance_m;
    for (const Vec3& corner : corners) {
        const Vec3 near_corner = corner + share_to_middle * (middle - corner);
        distance_m = std::min(distance_m, distance_around_m(coarse, side, near_corner));
    }
    return distance_m;
}

}  // namespace

patches::FinePatches patches_near_contacts(const PatchTransport& coarse, const SideLight& light,
                                           std::size_t most, const Monitor& monitor) {
    // Light that surfaces send varies over about the distance to them [Ward, Rubinstein, Clear 1988, A ray
    // tracing solution for diffuse interreflection: the harmonic mean of the distances]. The error [lx] is in
    // proportion to the light: where there is little, as behind a cupboard, edges may be longer.
    constexpr double dark_share = 1. / 10;
    const double dark_lx = dark_share * mean_lx(coarse, light);
    const auto longest_edge_m = [&](std::uint32_t patch, const std::array<Vec3, 3>& corners) {
        double limit_m = coarse.size_m;
        for (const std::uint32_t side : {patch, coarse.patches.other_side(patch)}) {
            if (!light.is_lit[side] || reflects_nothing(coarse.material_of(side))) continue;
            const double times_longer = std::max(1., dark_lx / light.lx[side]);
            limit_m = std::min(limit_m, times_longer * distance_around_m(coarse, side, corners));
        }
        return std::max(limit_m, kLeastShareOfSize * coarse.size_m);
    };
    return patches::make_fine_patches(coarse.scene, coarse.size_m, longest_edge_m, most, monitor,
                                      coarse.patches.center);
}

}  // namespace stilb::estimators
