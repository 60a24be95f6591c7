// Every triangle of a scene against Embree's hits, and closed meshes against rays at their edges.
#include "rays/few_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "support/closed_meshes.h"

namespace stilb::rays {
namespace {

constexpr double kRadius_m = 10;
constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

LaneMask lanes_up_to(std::size_t count) {
    LaneMask lanes{};
    std::fill_n(lanes.begin(), count, -1);
    return lanes;
}

Scene small_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, diffuse(0.5));
    add_object(scene, Box{{1, 1, 0.01}, {1.7, 1.6, 1.1}}, diffuse(0.5));
    add_object(scene, Rectangle{{2.5, 0.3, 0.9}, {1, 0.5, 0.2}, {-0.3, 0.6, 0}}, diffuse(0.5));
    return scene;
}

/// Scattered packets take FewTriangles, single rays Embree.
TEST(FewTriangles, HaveTheHitsOfEmbree) {
    const Scene scene = small_room();
    const RayCaster caster(scene);
    RandomPairs random(5);
    for (int round = 0; round < 2000; ++round) {
        RayHitPacket packet;
        std::array<Ray, kPacketWidth> rays;
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const auto [x, y] = random.next_pair();
            const auto [u1, u2] = random.next_pair();
            rays[i] = {{0.1 + 3.8 * x, 0.1 + 2.8 * y, 0.1 + 2.3 * random.next()},
                       math::sample_sphere(u1, u2).direction};
            packet.ray.set(i, rays[i].origin - caster.center(), rays[i].direction, kFloatInfinity);
        }
        caster.closest(packet, lanes_up_to(kPacketWidth), Coherence::scattered);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const auto hit = caster.closest(rays[i].origin, rays[i].direction);
            ASSERT_TRUE(hit);
            ASSERT_NE(packet.object[i], kNothing);
            const Hit found = caster.hit(packet, i);
            EXPECT_LT(length(found.position - hit->position), 1e-5) << round;
            EXPECT_NEAR(double{packet.ray.end[i]}, hit->distance_m, 1e-5);
            EXPECT_EQ(found.object, hit->object);
            EXPECT_EQ(found.triangle, hit->triangle);
            const Vec3 normal{packet.normal_x[i], packet.normal_y[i], packet.normal_z[i]};
            EXPECT_NEAR(dot(normal, hit->on_front ? hit->normal : -hit->normal), 1, 1e-5);
        }
    }
}

TEST(FewTriangles, OccludeAsEmbreeDoes) {
    const Scene scene = small_room();
    const RayCaster caster(scene);
    RandomPairs random(6);
    int differences = 0, occluded = 0;
    for (int round = 0; round < 2000; ++round) {
        RayPacket packet;
        std::array<Segment, kPacketWidth> segments;
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const auto [x, y] = random.next_pair();
            const auto [u, v] = random.next_pair();
            segments[i] = {{0.1 + 3.8 * x, 0.1 + 2.8 * y, 0.1}, {0.1 + 3.8 * u, 0.1 + 2.8 * v, 2.4}};
            packet.set(i, segments[i].from - caster.center(), segments[i].to - segments[i].from, 1);
        }
        caster.occlude(packet, lanes_up_to(kPacketWidth), Coherence::scattered);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const bool is_occluded = caster.occluded(segments[i].from, segments[i].to);
            occluded += is_occluded ? 1 : 0;
            differences += is_occluded != (packet.end[i] < 0) ? 1 : 0;
        }
    }
    EXPECT_GT(occluded, 1000);
    EXPECT_LE(differences, 1);  // a segment along an edge
}

/// Rays from the inside of closed meshes, at vertices, along edges and anywhere.
TEST(FewTriangles, LoseNoRays) {
    for (const ClosedMeshEntry& entry : kClosedMeshes) {
        const ClosedMesh closed = entry.make(3);
        if (closed.mesh.triangles.size() > FewTriangles::kMost) continue;
        Scene scene;
        add_object(scene, closed.mesh, diffuse(0.5));
        const RayCaster caster(scene);
        RandomPairs random(7);
        for (int round = 0; round < 20'000; ++round) {
            RayHitPacket packet;
            for (std::size_t i = 0; i < kPacketWidth; ++i) {
                const Triangle& triangle = closed.mesh.triangles[static_cast<std::size_t>(
                    random.next() * 0.999999 * static_cast<double>(closed.mesh.triangles.size()))];
                const Vec3 &a = closed.mesh.vertices[triangle[0]], &b = closed.mesh.vertices[triangle[1]];
                const double along = i % 2 == 0 ? 0 : random.next();
                const auto [u1, u2] = random.next_pair();
                const Vec3 direction = i % 4 == 3 ? math::sample_sphere(u1, u2).direction
                                                  : normalized(a + along * (b - a) - closed.inside);
                packet.ray.set(i, closed.inside - caster.center(), direction, kFloatInfinity);
            }
            RayPacket segments = packet.ray;
            segments.end.fill(100);
            caster.closest(packet, lanes_up_to(kPacketWidth), Coherence::scattered);
            caster.occlude(segments, lanes_up_to(kPacketWidth), Coherence::scattered);
            for (std::size_t i = 0; i < kPacketWidth; ++i) {
                EXPECT_NE(packet.object[i], kNothing) << entry.name;
                EXPECT_LT(segments.end[i], 0) << entry.name;
            }
        }
    }
}

/// A wall in the plane x = 0 of a room of `size_m`, in four rectangles around a square opening in its middle;
/// something large stands far behind.
Scene wall_with_opening(double size_m, double opening_m) {
    const double far = size_m / 2, near = opening_m / 2;
    Scene scene;
    add_object(scene, Box{{-far, -far, -far}, {far, far, far}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, -far, -far}, {0, far - near, 0}, {0, 0, size_m}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, near, -far}, {0, far - near, 0}, {0, 0, size_m}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, -near, -far}, {0, opening_m, 0}, {0, 0, far - near}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, -near, near}, {0, opening_m, 0}, {0, 0, far - near}}, diffuse(0.5));
    return scene;
}

/// Rays a little inside of an opening's edges pass, those a little outside do not: the opening has its area
/// to 0.01 %, if each edge lies where it is to 2.5e-5 of the side.
TEST(FewTriangles, LeaveOpeningsAsTheyAre) {
    constexpr double hair = 2.5e-5;
    for (const double size_m : {1.0, 6.0, 10.0}) {
        for (const double opening_m : {0.001, 0.03, 0.5}) {
            const Scene scene = wall_with_opening(size_m, opening_m);
            const RayCaster caster(scene);
            RandomPairs random(11);
            for (int round = 0; round < 500; ++round) {
                RayHitPacket packet;
                RayPacket segments;
                for (std::size_t i = 0; i < kPacketWidth; ++i) {
                    const double edge = (i % 2 == 0 ? 0.5 - hair : 0.5 + hair) * opening_m;
                    const double across = (i % 4 < 2 ? edge : -edge), along = (random.next() - 0.5) * edge;
                    const Vec3 at = i % 8 < 4 ? Vec3{0, across, along} : Vec3{0, along, across};
                    const auto [u, v] = random.next_pair();
                    const Vec3 origin =
                        std::min(opening_m, size_m / 4) * Vec3{0.5 + u, v - 0.5, random.next() - 0.5};
                    packet.ray.set(i, origin, at - origin, kFloatInfinity);
                    segments.set(i, origin, 1.5 * (at - origin), 1);
                }
                caster.closest(packet, lanes_up_to(kPacketWidth), Coherence::scattered);
                caster.occlude(segments, lanes_up_to(kPacketWidth), Coherence::scattered);
                for (std::size_t i = 0; i < kPacketWidth; ++i) {
                    EXPECT_EQ(packet.object[i] == 0, i % 2 == 0) << size_m << ' ' << opening_m << ' ' << i;
                    EXPECT_EQ(segments.end[i] > 0, i % 2 == 0) << size_m << ' ' << opening_m << ' ' << i;
                }
            }
        }
    }
}

/// A triangle a thousand kilometres away, or the size of the scene, changes nothing beside an edge.
TEST(FewTriangles, MissWhatIsBesideAnEdgeWhereverElseSomethingLies) {
    FewTriangles triangles{kRadius_m};
    triangles.add(0, 0, {{{1, 0, -1}, {1, 1, -1}, {1, 0, 1}}});
    triangles.add(1, 0, {{{1e6f, -1e6f, -1e6f}, {1e6f, 1e6f, -1e6f}, {1e6f, 0, 1e6f}}});
    RayHitPacket packet;
    for (std::size_t i = 0; i < kPacketWidth; ++i)
        packet.ray.set(i, {0, i % 2 == 0 ? -1e-7 : 1e-7, 0}, {1, 0, 0}, kFloatInfinity);
    triangles.closest(packet, lanes_up_to(kPacketWidth));
    for (std::size_t i = 0; i < kPacketWidth; ++i) EXPECT_EQ(packet.object[i], i % 2 == 0 ? 1 : 0) << i;
}

/// One triangle across the x-axis at x = 1.
FewTriangles one_triangle() {
    FewTriangles triangles{kRadius_m};
    triangles.add(3, 5, {{{1, -1, -1}, {1, 2, -1}, {1, -1, 2}}});
    return triangles;
}

TEST(FewTriangles, SetOnlyTheirLanes) {
    RayHitPacket packet;
    for (std::size_t i = 0; i < kPacketWidth; ++i) packet.ray.set(i, {0, 0, 0}, {1, 0, 0}, 7);
    RayPacket segments = packet.ray;
    one_triangle().closest(packet, lanes_up_to(2));
    one_triangle().occlude(segments, lanes_up_to(2));
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        EXPECT_EQ(packet.object[i], i < 2 ? 3 : kNothing);
        EXPECT_EQ(packet.ray.end[i], i < 2 ? 1 : 7);
        EXPECT_EQ(segments.end[i], i < 2 ? -kFloatInfinity : 7);
    }
    EXPECT_EQ(packet.primitive[0], 5);
    EXPECT_NEAR(packet.u[0], 1.0f / 3, 1e-6f);
    EXPECT_NEAR(packet.v[0], 1.0f / 3, 1e-6f);
}

TEST(FewTriangles, MeetRaysBetweenStartAndEnd) {
    RayHitPacket packet;
    packet.ray.set(0, {0, 0, 0}, {1, 0, 0}, 0.9f);                           // ends before
    packet.ray.set(1, {0, 0, 0}, {-1, 0, 0}, 5);                             // away from it
    packet.ray.set(2, {0, 0, 0}, {1, 0, 0}, 5), packet.ray.start[2] = 1.1f;  // starts behind
    packet.ray.set(3, {1, -3, 0}, {0, 1, 0}, 5);                             // in its plane
    packet.ray.set(4, {3, 0, 0}, {-4, 0, 0}, 5);                             // from behind
    RayPacket segments = packet.ray;
    one_triangle().closest(packet, lanes_up_to(5));
    one_triangle().occlude(segments, lanes_up_to(5));
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(packet.object[i], kNothing) << i;
        EXPECT_GT(segments.end[i], 0) << i;
    }
    EXPECT_EQ(packet.ray.end[4], 0.5f);
    EXPECT_LT(segments.end[4], 0);
}

TEST(FewTriangles, AreForPacketsThatAreFullEnough) {
    FewTriangles triangles{kRadius_m};
    for (std::uint32_t i = 0; i < FewTriangles::kMost / 2; ++i)
        triangles.add(0, i, {{{1, -1, -1}, {1, 2, -1}, {1, -1, 2}}});
    EXPECT_TRUE(triangles.are_faster(lanes_up_to(8)));
    EXPECT_FALSE(triangles.are_faster(lanes_up_to(7)));
}

}  // namespace
}  // namespace stilb::rays
