#include "patches/regular_patches.h"

#include <gtest/gtest.h>

#include <numeric>

#include "math/sampling.h"
#include "patches/rooms.h"
#include "support/random_pairs.h"

namespace stilb::patches {
namespace {

constexpr auto kEverywhere = [](ObjectId, MaterialId) { return true; };

/// A hall with walls that the caster cuts into parts, furniture, and a mesh with a triangle without area.
Scene hall() {
    Scene scene = furnished_room();
    scene.objects[0].shape = inward(Box{{0, 0, 0}, {30, 4, 3}});
    add_object(scene,
               Mesh{{{3, 0.3, 0}, {4, 0.3, 0}, {3.5, 0.3, 1}, {3.5, 0.8, 0}},
                    {{0, 1, 2}, {0, 0, 2}, {1, 3, 2}, {3, 0, 2}}},
               diffuse(0.5));
    return scene;
}

void look_around(const RegularPatches& regular, const rays::RayCaster& caster, const Scene& scene) {
    const Patches& patches = regular.patches();
    RandomPairs random(3);
    std::size_t met = 0, exact = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3 origin = point_in_room().position + Vec3{0.05 * i, 0, 0};
        rays::RayHitPacket packet;
        LaneMask lanes{};
        for (std::size_t lane = 0; lane < kPacketWidth; lane += 2) {
            const auto [u1, u2] = random.next_pair();
            packet.ray.set(lane, origin - caster.center(), math::sample_sphere(u1, u2).direction,
                           std::numeric_limits<float>::infinity());
            lanes[lane] = -1;
        }
        const PatchHits hits = regular.closest(packet, lanes, rays::Coherence::scattered);
        for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
            const bool is_exact = (hits.exact_lanes >> lane & 1u) != 0;
            if (lanes[lane] == 0) {
                EXPECT_EQ(hits.sides[lane], kNoSide);
                EXPECT_FALSE(is_exact);
                continue;
            }
            const rays::Hit hit = caster.hit(packet, lane);
            EXPECT_EQ(is_exact, geometry::is_exact(scene.object(hit.object).shape));
            if (is_exact) {
                ++exact;
                continue;
            }
            ++met;
            ASSERT_NE(hits.sides[lane], kNoSide);
            const std::uint32_t patch = patches.patch_of(hits.sides[lane]);
            EXPECT_EQ(patches.object_of(patch), hit.object);
            EXPECT_EQ(patches.materials[patch], hit.material);
            EXPECT_LT(length(patches.position(patch, hits.barycentric(lane)) - hit.position), 2e-5);
            EXPECT_NEAR(dot(patches.normal_of(hits.sides[lane]), hit.normal), 1, 1e-5);
        }
    }
    EXPECT_GT(met, 2000u);
    EXPECT_GT(exact, 5u);
}

TEST(RegularPatches, HitsAreWhereTheSceneIs) {
    const Scene scene = hall();
    const rays::RayCaster caster(scene);
    for (const double count : {1.0, 700.0, 20'000.0})
        look_around(RegularPatches(scene, caster, count, kEverywhere, Monitor::none()), caster, scene);
}

/// Parts of a triangle that become one point have no patches: the numbers of those behind them must not slip.
TEST(RegularPatches, HitsStayOnTheirSurfacesWhereTrianglesAreThin) {
    for (const double wall_m : {10., 1e5}) {
        Scene scene;
        add_object(scene, inward(Box{{0, 0, 0}, {8, 6, 3}}), diffuse(0.5));
        std::vector<Mesh> slivers;
        for (int i = 0; i < 8; ++i) {
            const double y = 1 + 0.5 * i, width = std::pow(10., i - 7);
            slivers.push_back({{{1, y, 1}, {7, y, 1}, {1.3, y + width, 1}}, {{0, 1, 2}}});
            add_object(scene, slivers.back(), diffuse(0.5));
        }
        add_object(scene, Rectangle{{0, 0, wall_m}, {6, 0, 0}, {0, 0, 2.8}}, diffuse(0.5));
        add_object(scene, Rectangle{{0.5, 0.1, 0.7}, {0.4, 0, 0}, {0, 0.4, 0}}, diffuse(0.5));
        const rays::RayCaster caster(scene);
        const RegularPatches regular(scene, caster, 20'000, kEverywhere, Monitor::none());
        const Patches& patches = regular.patches();
        RandomPairs random(5);
        std::size_t on_slivers = 0;
        for (const Mesh& sliver : slivers) {
            for (int i = 0; i < 200; ++i) {
                rays::RayHitPacket packet;
                LaneMask lanes{};
                for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
                    const auto [u1, u2] = random.next_pair();
                    const auto [b0, b1, b2] = math::sample_triangle(u1, u2);
                    const Vec3 target =
                        b0 * sliver.vertices[0] + b1 * sliver.vertices[1] + b2 * sliver.vertices[2];
                    const Vec3 origin{4, 3, 2.5};
                    packet.ray.set(lane, origin - caster.center(), target - origin,
                                   std::numeric_limits<float>::infinity());
                    lanes[lane] = -1;
                }
                const PatchHits hits = regular.closest(packet, lanes, rays::Coherence::scattered);
                for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
                    const std::uint32_t side = hits.sides[lane];
                    if (packet.object[lane] == rays::kNothing || side == kNoSide) continue;
                    ASSERT_LT(side, 2 * patches.count());
                    const std::uint32_t patch = patches.patch_of(side);
                    ASSERT_EQ(index_of(patches.object_of(patch)), packet.object[lane]);
                    ASSERT_GT(patches.areas_m2[patch], 0);
                    on_slivers += packet.object[lane] > 0;
                }
            }
        }
        EXPECT_GT(on_slivers, 1000u) << wall_m;
    }
}

TEST(RegularPatches, CoverTheirSurfacesWithAboutTheWantedNumber) {
    const Scene scene = hall();
    const rays::RayCaster caster(scene);
    const RegularPatches regular(scene, caster, 5000, kEverywhere, Monitor::none());
    const std::vector<float>& areas = regular.patches().areas_m2;
    double flat_m2 = 0;
    for (const Object& object : scene.objects) {
        if (!geometry::is_exact(object.shape)) flat_m2 += geometry::area_m2(object.shape);
    }
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), flat_m2, 1e-4 * flat_m2);
    EXPECT_GT(areas.size(), 4000u);
    EXPECT_LT(areas.size(), 6500u);
}

/// Neighbours share their vertices across a face: 2 n^2 triangles have
/// (n + 1)^2 vertices.
TEST(RegularPatches, ShareVerticesOnAFace) {
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, diffuse(0.5));
    const rays::RayCaster caster(scene);
    const RegularPatches regular(scene, caster, 800, kEverywhere, Monitor::none());
    const double parts = std::sqrt(static_cast<double>(regular.patches().count()) / 2);
    EXPECT_EQ(static_cast<double>(regular.patches().vertices.size()), (parts + 1) * (parts + 1));
}

TEST(RegularPatches, LeaveOutWhatShallHaveNone) {
    const Scene scene = furnished_room();
    const rays::RayCaster caster(scene);
    const RegularPatches regular(
        scene, caster, 1000, [](ObjectId object, MaterialId) { return index_of(object) != 1; },
        Monitor::none());
    rays::RayHitPacket packet;
    LaneMask lanes{};
    lanes[0] = lanes[1] = -1;
    const Vec3 above_cabinet = Vec3{1, 0.8, 2.5} - caster.center(),
               beside = Vec3{1.7, 0.8, 2.5} - caster.center();
    packet.ray.set(0, above_cabinet, {0, 0, -1}, std::numeric_limits<float>::infinity());
    packet.ray.set(1, beside, {0, 0, -1}, std::numeric_limits<float>::infinity());
    const PatchHits hits = regular.closest(packet, lanes, rays::Coherence::scattered);
    EXPECT_EQ(hits.exact_lanes, 1u);
    EXPECT_EQ(hits.sides[0], kNoSide);
    ASSERT_NE(hits.sides[1], kNoSide);
    EXPECT_EQ(regular.patches().object_of(regular.patches().patch_of(hits.sides[1])), ObjectId{0});
}

}  // namespace
}  // namespace stilb::patches
