// All surfaces along a ray, counted by the geometry.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "geometry/transform.h"
#include "rays/ray_caster.h"
#include "support/scene_builder.h"

namespace stilb::rays {
namespace {

/// Along no axis, diagonal or symmetry of boxes.
const Vec3 kDirection = normalized(Vec3{0.2673, 0.5345, 0.8018});

/// How often the ray crosses each object.
std::map<std::size_t, int> counts(const Scene& scene, const Vec3& origin) {
    const RayCaster caster(scene);
    std::map<std::size_t, int> counts;
    for (const Crossing& crossing : caster.crossings(origin, kDirection)) ++counts[index_of(crossing.object)];
    return counts;
}

using Counts = std::map<std::size_t, int>;

/// Ten layers of 10 cm that touch, from z = 1 m on; as boxes and as meshes, whose triangulations differ.
Scene layers(const Vec3& at) {
    Scene scene;
    for (int i = 0; i < 10; ++i) {
        const double margin = 0.05 * (i % 3), z = 1 + 0.1 * i;
        const Box box{at + Vec3{-3 - margin, -3, z}, at + Vec3{3 + margin, 3 + 2 * margin, z + 0.1}};
        add_object(scene, i % 2 == 0 ? Shape{box} : Shape{triangulated(box)}, diffuse(0.5));
    }
    return scene;
}

TEST(Crossings, OfSurfacesInOnePlaneEachCounts) {
    Counts twice_each;
    for (std::size_t i = 0; i < 10; ++i) twice_each[i] = 2;
    for (const Vec3& at : {Vec3{}, Vec3{4000, -700, 30}, Vec3{3.5e6, 5.4e6, 120}}) {
        const Scene scene = layers(at);
        for (int i = 0; i < 50; ++i) {
            const Vec3 origin = at + Vec3{-1.5 + 0.031 * i, -1.4 + 0.017 * i, 0.4};
            EXPECT_EQ(counts(scene, origin), twice_each) << at.x << ", ray " << i;
        }
    }
}

TEST(Crossings, BehindTheOriginDoNotCount) {
    Counts expected{{4, 1}};
    for (std::size_t i = 5; i < 10; ++i) expected[i] = 2;
    EXPECT_EQ(counts(layers({}), {0.1, 0.2, 1.45}), expected);
}

TEST(Crossings, OfFacesThatAMeshHasTwiceBothCount) {
    Mesh mesh = triangulated(Box{{-1, -1, 1}, {1, 1, 2}});
    const std::vector<Triangle> once = mesh.triangles;
    mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
    Scene scene;
    add_object(scene, mesh, diffuse(0.5));
    EXPECT_EQ(counts(scene, {-0.4, -0.6, 0.2}), (Counts{{0, 4}}));
}

TEST(Crossings, OfCurvedSurfacesAndInstances) {
    Scene scene;
    add_object(scene, Sphere{{0, 0, 3}, 2}, diffuse(0.5));
    add_object(scene, Disk{{0, 0, 1.5}, {0, 0, 1}, 2}, diffuse(0.5));
    const auto mesh = std::make_shared<const Mesh>(triangulated(Box{{0, 0, 0}, {1, 1, 1}}));
    // Two cubes, one upon the other, the upper one larger.
    add_object(scene, Instance{mesh, {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-1, -1, 1}}}, diffuse(0.5));
    add_object(scene, Instance{mesh, {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {-2, -2, 3}}}, diffuse(0.5));
    EXPECT_EQ(counts(scene, {-0.4, -0.9, 0.4}), (Counts{{0, 2}, {1, 1}, {2, 2}, {3, 2}}));
}

}  // namespace
}  // namespace stilb::rays
