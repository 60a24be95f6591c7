// Lamps that are faces of a closed mesh leave no gap at their edges.
#include "scene/cut_lamps.h"

#include <gtest/gtest.h>

#include "support/closed_meshes.h"

namespace stilb::rays {
namespace {

/// A closed mesh, every third triangle of which (by chance) is a lamp: edges of lamps are everywhere.
Scene cut_scene(const Mesh& mesh) {
    Scene scene;
    const ObjectId body = add_object(scene, mesh, diffuse(0.5));
    RandomPairs random(17);
    std::vector<std::uint32_t> lamp{0};
    for (std::uint32_t t = 1; t < mesh.triangles.size(); ++t) {
        if (random.next() < 1.0 / 3) lamp.push_back(t);
    }
    scene::cut_out(scene, body, lamp, "lamp");
    return scene;
}

TEST(CutLamps, LoseNoRay) {
    for (const ClosedMeshEntry& entry : kClosedMeshes) {
        for (const double size_m : {1e-3, 4.0, 1e4}) {
            const ClosedMesh closed = entry.make(size_m);
            for (const Queries queries : {Queries::single, Queries::packets}) {
                EXPECT_EQ(lost_rays(cut_scene(closed.mesh), closed.inside, queries, 300'000, 9), 0u)
                    << entry.name << ' ' << size_m << " m";
            }
        }
    }
}

/// Rays straight at the vertices and edges of lamps: single ones may slip through there in single precision,
/// but no others than through the whole mesh.
TEST(CutLamps, LoseNoMoreAtTheirEdgesThanTheWholeMesh) {
    const ClosedMesh closed = rough_sphere(3);
    const Scene cut = cut_scene(closed.mesh);
    Scene whole;
    add_object(whole, closed.mesh, diffuse(0.5));
    const RayCaster of_cut(cut), of_whole(whole);
    const Mesh& lamp = std::get<Mesh>(cut.objects[1].shape);
    RandomPairs random(8);
    int different = 0;
    for (const auto& [a, b, c] : lamp.triangles) {
        for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
            const Vec3 &p = lamp.vertices[from], &q = lamp.vertices[to];
            for (const double along : {0.0, random.next()}) {
                const Vec3 towards = p + along * (q - p) - closed.inside;
                const Vec3 direction = normalized(towards), beyond = closed.inside + 1.1 * towards;
                different += of_cut.closest(closed.inside, direction).has_value() !=
                             of_whole.closest(closed.inside, direction).has_value();
                different +=
                    of_cut.occluded(closed.inside, beyond) != of_whole.occluded(closed.inside, beyond);
            }
        }
    }
    EXPECT_EQ(different, 0);
}

TEST(CutLamps, KeepTheNormalsOfSmoothMeshes) {
    const Sphere sphere{{1, 2, 3}, 0.7};
    Scene whole, cut = cut_scene(smooth_icosphere(sphere, 2));
    add_object(whole, smooth_icosphere(sphere, 2), diffuse(0.5));
    const RayCaster of_whole(whole), of_cut(cut);
    RandomPairs random(12);
    int on_lamp = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto [u1, u2] = random.next_pair();
        const Vec3 direction = math::sample_sphere(u1, u2).direction;
        const auto expected = of_whole.closest(sphere.center + 2 * direction, -direction),
                   found = of_cut.closest(sphere.center + 2 * direction, -direction);
        ASSERT_TRUE(expected && found);
        EXPECT_LT(length(found->shading_normal - expected->shading_normal), 1e-6);
        on_lamp += found->object == ObjectId{1};
    }
    EXPECT_GT(on_lamp, 400);
    EXPECT_LT(on_lamp, 1000);
}

}  // namespace
}  // namespace stilb::rays
