#include "rays/surface_packet.h"

#include <gtest/gtest.h>

#include <limits>

#include "math/sampling.h"
#include "rays/ray_caster.h"
#include "support/random_pairs.h"
#include "support/scene_builder.h"

namespace stilb::rays {
namespace {

/// Packets have the hits of single rays: on triangles, also at their edges and of more than one material, on
/// curved shapes, and none where the scene is left.
TEST(SurfacePacket, HasTheHitsOfSingleRays) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 0.6}}, diffuse(0.5));
    add_object(scene, Sphere{{1, 1, 1}, 0.3}, diffuse(0.5));
    const ObjectId tent = add_object(
        scene,
        Mesh{{{2, 1, 0.7}, {3, 1, 0.7}, {2.5, 2, 0.7}, {2.5, 1.3, 2}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
        diffuse(0.5));
    scene.objects[index_of(tent)].materials = {add_material(scene, diffuse(0.5)),
                                               add_material(scene, diffuse(0.2)),
                                               add_material(scene, diffuse(0.3))};
    const RayCaster caster(scene);
    RandomPairs random(3);
    int hits = 0, misses = 0;
    for (int round = 0; round < 500; ++round) {
        RayHitPacket packet;
        LaneMask lanes{};
        std::array<Ray, kPacketWidth> rays;
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const auto [u1, u2] = random.next_pair();
            // Every eighth ray meets the tent's top, where edges meet.
            const Vec3 origin{4 * u1, 3 * u2, 2.5};
            const auto [v1, v2] = random.next_pair();
            const Vec3 direction = i % 8 == 0 ? normalized(Vec3{2.5, 1.3, 1.99999} - origin)
                                              : math::sample_sphere(v1, v2).direction;
            rays[i] = {origin, direction};
            packet.ray.set(i, origin - caster.center(), direction, std::numeric_limits<float>::infinity());
            lanes[i] = i == 3 ? 0 : -1;
        }
        caster.closest(packet, lanes, Coherence::scattered);
        SurfacePacket surfaces;
        caster.surfaces(packet, surfaces);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const auto hit = caster.closest(rays[i].origin, rays[i].direction);
            if (i == 3 || surfaces.object[i] == kNothing) {
                ++misses;
                EXPECT_EQ(surfaces.object[i], kNothing);
                continue;
            }
            if (!hit || index_of(hit->object) != surfaces.object[i]) continue;  // at an edge
            ++hits;
            EXPECT_LT(length(surfaces.position.at(i) + caster.center() - hit->position), 2e-6);
            EXPECT_LT(length(surfaces.lifted.at(i) + caster.center() - hit->lifted), 2e-6);
            if (hit->triangle != caster.hit(packet, i).triangle) continue;
            EXPECT_GT(dot(surfaces.normal.at(i), hit->normal), 1 - 1e-6);
            EXPECT_EQ(surfaces.material[i], index_of(hit->material));
            EXPECT_EQ(surfaces.is_on_front[i] != 0, hit->on_front);
            EXPECT_EQ(surfaces.is_smooth[i], 0);
        }
    }
    EXPECT_GT(hits, 1500);
    EXPECT_GT(misses, 1000);
}

TEST(SurfacePacket, NamesSmoothMeshes) {
    Scene scene;
    add_object(
        scene,
        Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{0, 0, 1}, {0.6, 0, 0.8}, {0, 0.6, 0.8}}},
        diffuse(0.5));
    const RayCaster caster(scene);
    RayHitPacket packet;
    LaneMask lanes{-1};
    packet.ray.set(0, Vec3{0.3, 0.3, 1} - caster.center(), {0, 0, -1}, 10);
    caster.closest(packet, lanes, Coherence::scattered);
    SurfacePacket surfaces;
    caster.surfaces(packet, surfaces);
    EXPECT_NE(surfaces.is_smooth[0], 0);
}

}  // namespace
}  // namespace stilb::rays
