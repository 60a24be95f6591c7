#include "fit/star_center.h"

#include <gtest/gtest.h>

#include <utility>

#include "fit/outward.h"
#include "support/prisms.h"
#include "support/scene_builder.h"

namespace stilb::fit {
namespace {

StarCenter center_of(const Mesh& mesh) { return find_star_center(mesh, RadialCaster(mesh)); }

void turn(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

TEST(Outward, LeavesWhatIsRight) {
    const OutwardMesh result = outward(l_prism());
    EXPECT_EQ(result.turned, 0u);
    EXPECT_EQ(result.open_edges, 0u);
    EXPECT_EQ(result.parts, 1u);
    EXPECT_EQ(result.mesh.triangles, l_prism().triangles);
}

TEST(Outward, TurnsSingleTrianglesAndWholeMeshes) {
    Mesh mesh = l_prism();
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) turn(mesh.triangles[i]);
    const OutwardMesh some = outward(mesh);
    EXPECT_EQ(some.turned, (mesh.triangles.size() + 2) / 3);
    EXPECT_EQ(superfluous_crossings(some.mesh, {0.5, 0.5, 0.5}),
              superfluous_crossings(l_prism(), {0.5, 0.5, 0.5}));
    mesh = u_prism();
    for (Triangle& triangle : mesh.triangles) turn(triangle);
    EXPECT_EQ(outward(mesh).turned, mesh.triangles.size());
}

TEST(Outward, KnowsPartsAndOpenEdges) {
    Mesh mesh = l_prism();
    const Mesh other = icosphere({{10, 0, 0}, 1}, 1);
    for (const auto& [a, b, c] : other.triangles) {
        const auto first = static_cast<std::uint32_t>(l_prism().vertices.size());
        mesh.triangles.push_back({a + first, c + first, b + first});
    }
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    mesh.triangles.erase(mesh.triangles.begin());
    const OutwardMesh result = outward(mesh);
    EXPECT_EQ(result.parts, 2u);
    EXPECT_EQ(result.open_edges, 3u);
    EXPECT_EQ(result.turned, other.triangles.size());
}

TEST(SuperfluousCrossings, AreThoseOfSimpleShapes) {
    const Mesh sphere = icosphere({{}, 1}, 3);
    EXPECT_NEAR(superfluous_crossings(sphere, {0.3, -0.5, 0.2}), 0, 1e-12);
    // Far outside: all is missing, and a small solid angle is crossed twice.
    EXPECT_NEAR(superfluous_crossings(sphere, {100, 0, 0}), 1, 1e-4);
    EXPECT_NEAR(superfluous_crossings(l_prism(), {0.5, 0.5, 0.5}), 0, 1e-12);
    EXPECT_GT(superfluous_crossings(l_prism(), {1.1, 1.1, 0.5}), 0.01);
}

TEST(StarCenter, IsFoundWhereTheMiddleOfTheVolumeIsNone) {
    const StarCenter found = center_of(l_prism());
    EXPECT_NEAR(found.margin, 0.5, 1e-5);
    EXPECT_NEAR(length(found.center - Vec3{0.5, 0.5, 0.5}), 0, 1e-4);
}

/// A star with five points, whose kernel is the small pentagon inside.
TEST(StarCenter, OfAStarIsItsMiddle) {
    std::vector<std::pair<double, double>> figure;
    std::vector<Triangle> triangles;
    const Vec3 middle{20, -3, 0};
    for (int i = 0; i < 10; ++i) {
        const double radius = i % 2 == 0 ? 1 : 0.3, angle = i * std::numbers::pi / 5;
        figure.emplace_back(middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle));
    }
    for (std::uint32_t i = 1; i < 10; i += 2) triangles.push_back({i, (i + 1) % 10, (i + 2) % 10});
    triangles.insert(triangles.end(), {{1, 3, 5}, {1, 5, 7}, {1, 7, 9}});
    const StarCenter found = center_of(prism(figure, triangles));
    EXPECT_GT(found.margin, 0.05);
    EXPECT_NEAR(found.center.x, middle.x, 1e-4);
    EXPECT_NEAR(found.center.y, middle.y, 1e-4);
}

TEST(StarCenter, IsNoneOfAU) {
    const Mesh mesh = u_prism();
    const StarCenter found = center_of(mesh);
    EXPECT_NEAR(found.margin, -0.5, 1e-5);
    // The search does better than the middle of the volume, and stays inside, away from the walls.
    EXPECT_LT(superfluous_crossings(mesh, found.center), superfluous_crossings(mesh, {1.5, 1.1, 0.5}));
    EXPECT_LT(superfluous_crossings(mesh, found.center), 0.5);
}

TEST(StarCenter, OfAnOpenMeshStaysInItsBox) {
    Mesh mesh = icosphere({{}, 1}, 2);
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]].z > 0.2; });
    const StarCenter found = center_of(mesh);
    EXPECT_GT(found.margin, 0.2);
    EXPECT_LT(length(found.center), 1);
}

}  // namespace
}  // namespace stilb::fit
