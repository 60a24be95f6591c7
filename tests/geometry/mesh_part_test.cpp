#include "geometry/mesh_part.h"

#include <gtest/gtest.h>

namespace stilb::geometry {
namespace {

using Indices = std::vector<std::uint32_t>;

/// Two squares side by side; with normals for some corners, or for all vertices.
const std::vector<Vec3> kVertices{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
const std::vector<Triangle> kTriangles{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};

TEST(MeshPart, HasTheVerticesOfItsTriangles) {
    const Mesh part = part_of({kVertices, kTriangles}, Indices{2, 3});
    EXPECT_EQ(part.vertices, (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}));
    EXPECT_EQ(part.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(part.normals.empty());
    EXPECT_TRUE(part.corner_normals.empty());
}

TEST(MeshPart, KeepsNormalsOfVertices) {
    std::vector<Vec3> normals;
    for (std::size_t v = 0; v < kVertices.size(); ++v) normals.push_back({0, 0, static_cast<double>(v)});
    const Mesh part = part_of({kVertices, kTriangles, normals}, Indices{3});
    EXPECT_EQ(part.normals, (std::vector<Vec3>{{0, 0, 1}, {0, 0, 5}, {0, 0, 4}}));
}

TEST(MeshPart, KeepsNormalsOfCorners) {
    const std::vector<Vec3> normals{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    const std::vector<Triangle> corners{
        {0, 0, 0}, {1, 2, kNoNormal}, {kNoNormal, kNoNormal, kNoNormal}, {2, 2, 0}};
    const Mesh part = part_of({kVertices, kTriangles, normals, corners}, Indices{1, 3});
    EXPECT_EQ(part.normals, (std::vector<Vec3>{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}));
    EXPECT_EQ(part.corner_normals, (std::vector<Triangle>{{0, 1, kNoNormal}, {1, 1, 2}}));
}

TEST(MeshPart, SeveralPartsAreThoseOneByOne) {
    const std::vector<Vec3> normals{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    const std::vector<Triangle> corners{{0, 0, 0}, {1, 2, kNoNormal}, {0, 1, 2}, {2, 2, 0}};
    const Mesh mesh{kVertices, kTriangles, normals, corners};
    const std::vector<Indices> numbers{{0, 2}, {1}, {3, 0}};
    const std::vector<Mesh> parts = parts_of(mesh, numbers);
    ASSERT_EQ(parts.size(), numbers.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Mesh part = part_of(mesh, numbers[i]);
        EXPECT_EQ(parts[i].vertices, part.vertices);
        EXPECT_EQ(parts[i].triangles, part.triangles);
        EXPECT_EQ(parts[i].normals, part.normals);
        EXPECT_EQ(parts[i].corner_normals, part.corner_normals);
    }
}

TEST(MeshPart, OthersAreTheRest) {
    EXPECT_EQ(others(5, Indices{1, 4}), (Indices{0, 2, 3}));
    EXPECT_EQ(others(3, Indices{}), (Indices{0, 1, 2}));
    EXPECT_EQ(others(2, Indices{0, 1}), Indices{});
}

}  // namespace
}  // namespace stilb::geometry
