#include <gtest/gtest.h>

#include <map>

#include "geometry/mesh_topology.h"
#include "math/random.h"

namespace stilb::geometry {
namespace {

Mesh joined(Mesh first, const Mesh& second) {
    const auto offset = static_cast<std::uint32_t>(first.vertices.size());
    first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
    for (const auto& [a, b, c] : second.triangles)
        first.triangles.push_back({a + offset, b + offset, c + offset});
    return first;
}

/// Every triangle with three vertices of its own, as many files have them.
Mesh unwelded(const Mesh& mesh) {
    Mesh result;
    for (const Triangle& triangle : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(result.vertices.size());
        for (const std::uint32_t vertex : triangle) result.vertices.push_back(mesh.vertices[vertex]);
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

const Box kUnitBox{{0, 0, 0}, {1, 1, 1}};

TEST(ConnectedComponents, ABoxIsOneClosedShell) {
    const ConnectedComponents components = find_components(Shape{kUnitBox});
    EXPECT_EQ(components.count(), 1u);
    EXPECT_TRUE(components.is_closed(0));
    EXPECT_EQ(components.turned_edges, 0u);
    EXPECT_EQ(components.of_triangle, std::vector<std::uint32_t>(12, 0));
}

TEST(ConnectedComponents, RepeatedVerticesAreOne) {
    const ConnectedComponents components = find_components(unwelded(triangulated(kUnitBox)));
    EXPECT_EQ(components.count(), 1u);
    EXPECT_TRUE(components.is_closed(0));
}

TEST(ConnectedComponents, AMissingTriangleOpensItsThreeEdges) {
    Mesh mesh = unwelded(triangulated(kUnitBox));
    mesh.triangles.pop_back();
    const ConnectedComponents components = find_components(mesh);
    EXPECT_EQ(components.count(), 1u);
    EXPECT_EQ(components.total_open_edges(), 3u);
}

TEST(ConnectedComponents, ARectangleHasFourOpenEdges) {
    EXPECT_EQ(find_components(Shape{Rectangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}).total_open_edges(), 4u);
}

TEST(ConnectedComponents, SpheresAreClosedAndDisksAreNot) {
    EXPECT_TRUE(find_components(Shape{Sphere{{0, 0, 0}, 1}}).is_closed(0));
    EXPECT_FALSE(find_components(Shape{Disk{{0, 0, 0}, {0, 0, 1}, 1}}).is_closed(0));
}

TEST(ConnectedComponents, SeparatePartsAreSeparateShells) {
    Mesh open_box = triangulated(Box{{2, 0, 0}, {3, 1, 1}});
    open_box.triangles.erase(open_box.triangles.begin());
    const ConnectedComponents components = find_components(joined(triangulated(kUnitBox), open_box));
    ASSERT_EQ(components.count(), 2u);
    EXPECT_TRUE(components.is_closed(0));
    EXPECT_FALSE(components.is_closed(1));
    EXPECT_EQ(components.of_triangle.front(), 0u);
    EXPECT_EQ(components.of_triangle.back(), 1u);
}

TEST(ConnectedComponents, BoxesThatShareAnEdgeStayClosed) {
    const ConnectedComponents components =
        find_components(joined(triangulated(kUnitBox), triangulated(Box{{1, 1, 0}, {2, 2, 1}})));
    EXPECT_EQ(components.total_open_edges(), 0u);
    EXPECT_EQ(components.turned_edges, 0u);
}

TEST(ConnectedComponents, AFlippedTriangleTurnsItsThreeEdges) {
    Mesh mesh = triangulated(kUnitBox);
    std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
    const ConnectedComponents components = find_components(mesh);
    EXPECT_EQ(components.total_open_edges(), 0u);
    EXPECT_EQ(components.turned_edges, 3u);
}

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;
using Uses = std::vector<std::pair<std::uint32_t, bool>>;  // triangle, and whether it runs upwards

std::vector<std::pair<EdgeKey, Uses>> edges_by_sorting(const std::vector<Triangle>& triangles,
                                                       const std::vector<std::uint32_t>& vertex_at) {
    std::map<EdgeKey, Uses> uses;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t from = vertex_at[triangles[t][side]];
            const std::uint32_t to = vertex_at[triangles[t][(side + 1) % 3]];
            uses[std::minmax(from, to)].emplace_back(t, from < to);
        }
    }
    return {uses.begin(), uses.end()};
}

TEST(Edges, AreThoseOfAllSidesInOrder) {
    math::SampleStream stream(math::RandomKey{7}, 0);
    const auto any = [&] { return static_cast<std::uint32_t>(stream.next() * 40); };
    std::vector<std::uint32_t> vertex_at(40);
    for (std::uint32_t v = 0; v < 40; ++v) vertex_at[v] = v % 35;  // five vertices are repeated
    std::vector<Triangle> triangles;
    while (triangles.size() < 500) {
        const Triangle t{any(), any(), any()};
        const std::uint32_t a = vertex_at[t[0]], b = vertex_at[t[1]], c = vertex_at[t[2]];
        if (a != b && b != c && c != a) triangles.push_back(t);
    }
    std::vector<std::pair<EdgeKey, Uses>> found;
    Edges(triangles, vertex_at).for_each([&](auto first, auto last) {
        Uses uses;
        for (auto use = first; use != last; ++use) uses.emplace_back(use->triangle, use->upwards);
        found.emplace_back(EdgeKey{first->low, first->high}, uses);
    });
    EXPECT_EQ(found, edges_by_sorting(triangles, vertex_at));
}

TEST(Welded, VerticesAtOnePositionAreTheFirstOfThem) {
    const std::vector<Vec3> vertices{{0, 1, 2},         {3, 4, 5}, {-0.0, 1, 2},
                                     {3, 4, 5.0000001}, {3, 4, 5}, {0, 1, 2}};
    EXPECT_EQ(welded(vertices), (std::vector<std::uint32_t>{0, 1, 0, 3, 1, 0}));
    EXPECT_TRUE(welded({}).empty());
}

}  // namespace
}  // namespace stilb::geometry
