#include "geometry/transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shape.h"

namespace stilb::geometry {
namespace {

void expect_near(const Vec3& actual, const Vec3& expected) {
    EXPECT_LT(length(actual - expected), 1e-12) << actual.x << ' ' << actual.y << ' ' << actual.z << " for "
                                                << expected.x << ' ' << expected.y << ' ' << expected.z;
}

const Transform kMirror{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}};

Vec3 front(const Mesh& mesh, const Triangle& t) {
    return cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

/// A closed mesh's volume is positive exactly where its fronts are outside.
double volume(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) sum += dot(mesh.vertices[t[0]], front(mesh, t)) / 6;
    return sum;
}

TEST(Transform, RotatesRightHanded) {
    const Transform quarter = Transform::rotation({0, 0, 1}, 90);
    expect_near(quarter.point({1, 0, 5}), {0, 1, 5});
    expect_near(Transform::rotation(normalized({1, 1, 1}), 120).point({1, 0, 0}), {0, 1, 0});
}

TEST(Transform, ComposesInOrder) {
    const Transform moved{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {10, 0, 0}};
    const Transform scale_then_move = compose(moved, Transform::scaling(2));
    expect_near(scale_then_move.point({1, 2, 3}), {12, 4, 6});
    expect_near(compose(Transform::scaling(2), moved).point({1, 2, 3}), {22, 4, 6});
    expect_near(scale_then_move.direction({1, 2, 3}), {2, 4, 6});
}

TEST(Transform, TellsSimilaritiesAndFlatOnes) {
    EXPECT_TRUE(compose(Transform::scaling(3), Transform::rotation({0, 1, 0}, 20)).is_similarity());
    EXPECT_TRUE(kMirror.is_similarity());
    EXPECT_FALSE((Transform{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}).is_similarity());
    EXPECT_FALSE((Transform{{1, 0, 0}, {0.1, 1, 0}, {0, 0, 1}, {}}).is_similarity());
    EXPECT_NEAR((Transform{{1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {}}).regularity(), 0, 1e-15);
    EXPECT_EQ((Transform{{1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {}}).regularity(), 0);
}

TEST(Transform, NormalsStayAtRightAnglesAndOutside) {
    const std::array<Transform, 4> transforms{
        Transform::rotation(normalized({1, 2, 3}), 70), kMirror,
        Transform{{2, 0, 0}, {0.3, 0.5, 0}, {0, -0.7, 3}, {1, 2, 3}},
        Transform{{-2, 0.1, 0}, {0.3, 0.5, 0}, {0, -0.7, 3}, {1, 2, 3}}};
    for (const Transform& transform : transforms) {
        Mesh box = triangulated(Box{{-1, -2, -3}, {1, 2, 3}});
        for (std::uint32_t t = 0; t < box.triangles.size(); ++t) {
            box.normals.push_back(normalized(front(box, box.triangles[t])));
            box.corner_normals.push_back({t, t, t});
        }
        const Mesh moved = std::get<Mesh>(transformed(box, transform));
        for (std::uint32_t t = 0; t < moved.triangles.size(); ++t)
            expect_near(moved.normals[t], normalized(front(moved, moved.triangles[t])));
    }
    expect_near(kMirror.normal({}), {});
}

TEST(Transform, TurnedTrianglesTakeTheirNormalsAlong) {
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{2, 1, 0}}};
    const auto moved = std::get<Mesh>(transformed(mesh, kMirror));
    EXPECT_EQ(moved.triangles[0], (Triangle{0, 2, 1}));
    EXPECT_EQ(moved.corner_normals[0], (Triangle{2, 0, 1}));
}

TEST(Transform, MirroringKeepsFrontsInFront) {
    const Mesh box = triangulated(Box{{1, 1, 1}, {2, 3, 4}});
    EXPECT_NEAR(volume(box), 6, 1e-12);
    EXPECT_NEAR(volume(std::get<Mesh>(transformed(box, kMirror))), 6, 1e-12);
    const auto ceiling =
        std::get<Rectangle>(transformed(Rectangle{{0, 0, 3}, {0, 2, 0}, {1, 0, 0}}, kMirror));
    expect_near(cross(ceiling.edge_u, ceiling.edge_v), {0, 0, -2});
    expect_near(ceiling.corner, {0, 0, 3});
}

TEST(Transform, BoxesStayBoxesWhileTheirAxesStay) {
    const auto box = std::get<Box>(transformed(Box{{1, 1, 1}, {2, 3, 4}}, kMirror));
    expect_near(box.min, {-2, 1, 1});
    expect_near(box.max, {-1, 3, 4});
    const Shape turned = transformed(Box{{1, 1, 1}, {2, 3, 4}}, Transform::rotation({0, 0, 1}, 30));
    EXPECT_NEAR(volume(std::get<Mesh>(turned)), 6, 1e-12);
    EXPECT_NEAR(area_m2(turned), 22, 1e-12);
}

TEST(Transform, MovesSpheresAndDisks) {
    const Transform t = compose(Transform{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 0, 0}},
                                compose(Transform::scaling(2), Transform::rotation({0, 0, 1}, 90)));
    const auto sphere = std::get<Sphere>(transformed(Sphere{{1, 0, 0}, 0.5}, t));
    expect_near(sphere.center, {5, 2, 0});
    EXPECT_NEAR(sphere.radius, 1, 1e-12);
    const auto disk = std::get<Disk>(transformed(Disk{{1, 0, 0}, {1, 0, 0}, 0.5}, t));
    expect_near(disk.normal, {0, 1, 0});
    EXPECT_NEAR(disk.radius, 1, 1e-12);
    expect_near(std::get<Disk>(transformed(Disk{{0, 0, 0}, {1, 0, 0}, 1}, kMirror)).normal, {-1, 0, 0});
}

}  // namespace
}  // namespace stilb::geometry
