#include "walk/display/coarse_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stilb::walk {
namespace {

constexpr double kRadius_m = 2;

/// Adds a part that is a sheet of n x n squares, bent to where `place` puts a point of the unit square.
template <typename Place>
void add_sheet(DisplayMesh& mesh, std::uint32_t n, const Place& place) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    DisplayPart part;
    part.first = mesh.triangles.size();
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) {
            DisplayVertex& vertex = mesh.vertices.emplace_back();
            vertex.position = place(i / static_cast<double>(n), j / static_cast<double>(n));
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = first + i * (n + 1) + j, b = a + n + 1;
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    part.count = mesh.triangles.size() - part.first;
    mesh.parts.push_back(part);
}

/// Half of a ball far away from the origin, and a small square.
DisplayMesh ball_and_square() {
    DisplayMesh mesh;
    add_sheet(mesh, 200, [](double u, double v) {
        const double theta = std::numbers::pi * (0.1 + 0.8 * u), phi = std::numbers::pi * v;
        return Vec3{1000 + kRadius_m * std::sin(theta) * std::cos(phi),
                    kRadius_m * std::sin(theta) * std::sin(phi), kRadius_m * std::cos(theta)};
    });
    add_sheet(mesh, 2, [](double u, double v) { return Vec3{u, v, 0}; });
    return mesh;
}

double area_m2(const DisplayMesh& mesh, const std::vector<Triangle>& triangles) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 p = mesh.vertices[a].position;
        sum += length(cross(mesh.vertices[b].position - p, mesh.vertices[c].position - p)) / 2;
    }
    return sum;
}

TEST(CoarseTriangles, KeepTheShapeOfLargeParts) {
    const DisplayMesh mesh = ball_and_square();
    const CoarseTriangles coarse = coarse_triangles(mesh, 8000);
    ASSERT_EQ(coarse.parts.size(), 2u);
    EXPECT_LE(coarse.triangles.size(), 8100u);
    EXPECT_GT(coarse.triangles.size(), 7000u);
    EXPECT_NEAR(area_m2(mesh, coarse.triangles), area_m2(mesh, mesh.triangles),
                0.01 * area_m2(mesh, mesh.triangles));
    for (std::size_t i = 0; i < coarse.parts[0].count; ++i) {
        for (const std::uint32_t corner : coarse.triangles[i])
            EXPECT_LT(corner, 201u * 201u) << "a vertex of another part";
    }
}

TEST(CoarseTriangles, KeepSmallPartsAsTheyAre) {
    const DisplayMesh mesh = ball_and_square();
    const CoarseTriangles coarse = coarse_triangles(mesh, 8000);
    ASSERT_EQ(coarse.parts.size(), 2u);
    const auto& [first, count] = coarse.parts[1];
    EXPECT_EQ(count, mesh.parts[1].count);
    EXPECT_EQ(first + count, coarse.triangles.size());
    EXPECT_TRUE(std::equal(coarse.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                           coarse.triangles.end(),
                           mesh.triangles.begin() + static_cast<std::ptrdiff_t>(mesh.parts[1].first)));
}

TEST(CoarseTriangles, AreOnlyForManyTriangles) {
    const DisplayMesh mesh = ball_and_square();
    EXPECT_TRUE(coarse_triangles(mesh, mesh.triangles.size()).triangles.empty());
    EXPECT_TRUE(coarse_triangles(mesh, mesh.triangles.size()).parts.empty());
}

}  // namespace
}  // namespace stilb::walk
