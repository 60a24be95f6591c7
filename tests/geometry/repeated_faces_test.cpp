#include "geometry/repeated_faces.h"

#include <gtest/gtest.h>

namespace stilb::geometry {
namespace {

std::vector<std::uint32_t> numbers_of(const std::vector<RepeatedFace>& faces) {
    std::vector<std::uint32_t> numbers;
    for (const RepeatedFace& face : faces) numbers.push_back(face.triangle);
    return numbers;
}
using Indices = std::vector<std::uint32_t>;

const std::vector<Vec3> kSquare{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};

TEST(RepeatedFaces, AreAllButTheFirst) {
    const Mesh mesh{kSquare, {{0, 1, 2}, {0, 2, 3}, {1, 2, 0}, {0, 2, 3}, {0, 1, 2}}};
    EXPECT_EQ(numbers_of(repeated_faces(mesh)), (Indices{2, 3, 4}));
    EXPECT_EQ(repeated_faces(mesh)[0].original, 0u);
    EXPECT_EQ(repeated_faces(mesh)[1].original, 1u);
}

TEST(RepeatedFaces, OfPolygonsCutInAnotherWay) {
    std::vector<Vec3> twice = kSquare;
    twice.insert(twice.end(), kSquare.begin(), kSquare.end());
    EXPECT_EQ(numbers_of(repeated_faces(Mesh{twice, {{0, 1, 2}, {0, 2, 3}, {5, 6, 7}, {5, 7, 4}}})),
              (Indices{2, 3}));
}

TEST(RepeatedFaces, NotTheirOtherSidesNorNeighbours) {
    EXPECT_TRUE(repeated_faces(Mesh{kSquare, {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}}}).empty());
    const Mesh folded{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}}, {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_TRUE(repeated_faces(folded).empty());
    // A part of it, and half beside it.
    const Mesh parts{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {0, -4, 0}, {0, 2, 0}, {2, -2, 0}},
                     {{0, 1, 2}, {0, 3, 5}, {0, 6, 3}}};
    EXPECT_EQ(numbers_of(repeated_faces(parts)), Indices{1});
}

}  // namespace
}  // namespace stilb::geometry
