#include "geometry/cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace stilb::geometry {
namespace {

/// Two squares of a folded sheet, as one mesh of four triangles.
Mesh folded_sheet(double size_m) {
    const double s = size_m;
    return {{{0, 0, 0}, {s, 0, 0}, {s, s, 0}, {0, s, 0}, {0, 0, s}, {s, 0, s}},
            {{0, 1, 2}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4}}};
}

double area_of(const std::vector<Vec3>& vertices, const Triangle& t) {
    return length(cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]])) / 2;
}

TEST(LargeTriangles, AreKeptWhereTheyAreSmallEnough) {
    const Mesh mesh = folded_sheet(10);
    const CutTriangles cut = cut_large_triangles(mesh, {0, 0, 0}, 15);
    EXPECT_EQ(cut.vertices.size(), mesh.vertices.size());
    EXPECT_EQ(cut.triangles, mesh.triangles);
    EXPECT_EQ(cut.parents, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(LargeTriangles, BecomeSmallNearTheCenterAndKeepTheirArea) {
    const Mesh mesh = folded_sheet(10'000);
    const Vec3 center{2000, 1000, 30};
    const CutTriangles cut = cut_large_triangles(mesh, center, 32);
    EXPECT_LT(cut.triangles.size(), 2000U);
    std::vector<double> areas_m2(mesh.triangles.size());
    for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
        const Triangle& t = cut.triangles[i];
        areas_m2[cut.parents[i]] += area_of(cut.vertices, t);
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const Vec3 &a = cut.vertices[t[edge]], &b = cut.vertices[t[(edge + 1) % 3]];
            EXPECT_LE(length(b - a), std::max(32.0, length(0.5 * (a + b) - center)));
        }
    }
    for (std::size_t i = 0; i < areas_m2.size(); ++i)
        EXPECT_NEAR(areas_m2[i], area_of(mesh.vertices, mesh.triangles[i]), 1);
}

/// Every edge inside of the sheet belongs to two triangles, so that no ray passes in between.
TEST(LargeTriangles, LeaveNoGaps) {
    const CutTriangles cut = cut_large_triangles(folded_sheet(10'000), {2000, 1000, 30}, 32);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const Triangle& t : cut.triangles) {
        for (std::size_t edge = 0; edge < 3; ++edge) ++uses[std::minmax(t[edge], t[(edge + 1) % 3])];
    }
    const auto is_on_border = [&](std::uint32_t a, std::uint32_t b) {
        const Vec3 &p = cut.vertices[a], &q = cut.vertices[b];
        return (p.x == 0 && q.x == 0) || (p.x == 10'000 && q.x == 10'000) ||
               (p.y == 10'000 && q.y == 10'000) || (p.z == 10'000 && q.z == 10'000);
    };
    for (const auto& [edge, count] : uses) EXPECT_EQ(count, is_on_border(edge.first, edge.second) ? 1 : 2);
}

}  // namespace
}  // namespace stilb::geometry
