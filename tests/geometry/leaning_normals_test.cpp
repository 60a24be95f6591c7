// Vertex normals that lean away from their faces.
#include "geometry/leaning_normals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stilb::geometry {
namespace {

/// A triangle whose three normals lean by this angle in one direction.
Mesh leaning(double angle_deg) {
    const double angle = angle_deg * kPi / 180;
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    mesh.normals.assign(3, Vec3{std::sin(angle), 0, std::cos(angle)});
    return mesh;
}

bool is_flat(const Mesh& mesh) {
    constexpr double third = 1.0 / 3;
    return shading_normal(mesh, 0, {third, third, third}, {0, 0, 1}) == Vec3{0, 0, 1};
}

TEST(LeaningNormals, FlattenTrianglesBeyondTheLimit) {
    for (const double angle_deg : {0.0, 30.0, kMostLean_deg - 1, kMostLean_deg - 1e-6}) {
        Mesh mesh = leaning(angle_deg);
        EXPECT_EQ(drop_leaning_normals(mesh), 0u) << angle_deg;
        EXPECT_TRUE(mesh.corner_normals.empty());
    }
    for (const double angle_deg : {kMostLean_deg + 1e-6, kMostLean_deg + 1, 60.0, 89.0, 120.0}) {
        Mesh mesh = leaning(angle_deg);
        EXPECT_EQ(drop_leaning_normals(mesh), 1u) << angle_deg;
        EXPECT_TRUE(is_flat(mesh)) << angle_deg;
    }
    // Those of the back are used by their opposites.
    Mesh back = leaning(180 - 30);
    EXPECT_EQ(drop_leaning_normals(back), 0u);
}

TEST(LeaningNormals, OfCoarseSmoothSurfacesStay) {
    // An octahedron: each normal leans by 55 degrees, but to all sides, and not in the middle of a face.
    Mesh mesh{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}}};
    mesh.normals = mesh.vertices;
    EXPECT_EQ(drop_leaning_normals(mesh), 0u);
}

TEST(LeaningNormals, OtherTrianglesKeepTheirs) {
    Mesh mesh = leaning(10);
    mesh.vertices.insert(mesh.vertices.end(), {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}});
    mesh.triangles.push_back({3, 4, 5});
    mesh.normals.resize(6, Vec3{1, 0, 0});
    EXPECT_EQ(drop_leaning_normals(mesh), 1u);
    EXPECT_FALSE(is_flat(mesh));
    EXPECT_EQ(mesh.corner_normals[0], (Triangle{0, 1, 2}));
    EXPECT_EQ(mesh.corner_normals[1], (Triangle{kNoNormal, kNoNormal, kNoNormal}));
}

}  // namespace
}  // namespace stilb::geometry
