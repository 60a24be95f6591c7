// Rays against patches.
#include "patches/visibility/patch_caster.h"

#include <gtest/gtest.h>

#include "math/sampling.h"
#include "patches/backends.h"
#include "patches/rooms.h"
#include "support/random_pairs.h"

namespace stilb::patches {
namespace {

/// Rays in all directions from a position in the room, relative to the patches' centre.
RayPacket random_rays(const Vec3& origin, RandomPairs& random) {
    RayPacket rays;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        const auto [u1, u2] = random.next_pair();
        set_ray(rays, i, origin, math::sample_sphere(u1, u2).direction);
    }
    return rays;
}

/// What a hit says of itself is one position: along the ray, on the patch; and the scene's shapes are
/// there, up to the sagitta of round ones.
TEST(PatchCaster, HitsAreWhereTheSceneIs) {
    const Scene scene = furnished_room();
    const Patches patches = make_patches(scene, 0.2);
    const PatchCaster caster(patches);
    const rays::RayCaster exact(scene);
    const Vec3 barycentric = point_in_room().position;
    RandomPairs random(11);
    std::size_t same_object = 0;
    constexpr int packets = 100;
    for (int i = 0; i < packets; ++i) {
        RayPacket rays = random_rays(barycentric - patches.center, random);
        LaneMask lanes{};
        for (std::size_t lane = 0; lane < kPacketWidth; lane += 2) lanes[lane] = -1;
        const PatchHits hits = caster.closest(rays, lanes);
        for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
            if (lanes[lane] == 0) {
                EXPECT_EQ(hits.sides[lane], kNoSide);
                continue;
            }
            const Vec3 direction{rays.direction_x[lane], rays.direction_y[lane], rays.direction_z[lane]};
            const std::uint32_t patch = patches.patch_of(hits.sides[lane]);
            const Vec3 on_patch = patches.position(patch, hits.barycentric(lane));
            EXPECT_LT(length(barycentric + rays.end[lane] * direction - on_patch), 1e-5);
            EXPECT_LT(dot(direction, patches.normal_of(hits.sides[lane])), 0);
            const auto hit = exact.closest(barycentric, direction);
            ASSERT_TRUE(hit);
            if (hit->object != patches.object_of(patch)) continue;
            ++same_object;
            EXPECT_LT(length(hit->position - on_patch), 0.05);
        }
    }
    EXPECT_GT(same_object, packets * kPacketWidth / 2 * 99 / 100);
}

/// Where the processor has no packets of sixteen, Embree traces the rays of all lanes.
TEST(PatchCaster, LeavesLanesAloneThatAreNotSet) {
    const Patches patches = make_patches(furnished_room(), 0.2);
    const PatchCaster caster(patches);
    RandomPairs random(12);
    const RayPacket rays = random_rays(point_in_room().position - patches.center, random);
    LaneMask lanes{};
    lanes[3] = lanes[9] = -1;
    PacketCrossings crossings;
    caster.all(rays, lanes, crossings);
    RayPacket after = rays;
    caster.closest(after, lanes);
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
        EXPECT_EQ(crossings[lane].empty(), lanes[lane] == 0) << lane;
        EXPECT_EQ(after.end[lane] == rays.end[lane], lanes[lane] == 0) << lane;
    }
}

}  // namespace
}  // namespace stilb::patches
