#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "io/mesh/mesh_file.h"

namespace stilb::io {
namespace {

using Polygon = std::vector<Vec3>;

/// Area times normal, by the shoelace sum over the border: no triangulation is in it.
Vec3 border_area(const Polygon& polygon) {
    Vec3 sum;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += 0.5 * cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return sum;
}

Vec3 area_vector(const Polygon& polygon, const Triangle& t) {
    return 0.5 * cross(polygon[t[1]] - polygon[t[0]], polygon[t[2]] - polygon[t[0]]);
}

/// Triangles of the polygon's orientation whose areas add up to the polygon's cannot overlap or stick out;
/// that each border edge is some triangle's edge, and each inner edge is shared, leaves no T junction.
void expect_faithful(const Polygon& polygon) {
    const std::vector<Triangle> triangles = triangulate_polygon(polygon);
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    const Vec3 whole = border_area(polygon);
    const double area = length(whole);
    double sum = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : triangles) {
        const Vec3 part = area_vector(polygon, t);
        EXPECT_GT(dot(part, whole), 1e-13 * area * area) << t[0] << " " << t[1] << " " << t[2];
        sum += length(part);
        for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    }
    EXPECT_NEAR(sum, area, 1e-12 * area);
    const auto count = static_cast<std::uint32_t>(polygon.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::pair border{i, (i + 1) % count};
        EXPECT_EQ(edges.count(border), 1U) << "border edge from " << i;
        edges.erase(border);
    }
    for (const auto& [edge, uses] : edges) {
        EXPECT_EQ(uses, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1U) << edge.first << " " << edge.second;
    }
}

/// As it is, from every first corner, turned over, and tilted in space.
void expect_faithful_in_all_positions(Polygon polygon) {
    const Frame frame = Frame::around(normalized(Vec3{0.3, -0.5, 0.4}));
    for (std::size_t start = 0; start < polygon.size(); ++start) {
        SCOPED_TRACE(start);
        Polygon tilted;
        for (const Vec3& p : polygon) tilted.push_back(Vec3{10, 20, -5} + frame.to_world(p));
        expect_faithful(polygon);
        expect_faithful(Polygon(polygon.rbegin(), polygon.rend()));
        expect_faithful(tilted);
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    }
}

TEST(TriangulatePolygon, convex) {
    expect_faithful_in_all_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    expect_faithful_in_all_positions({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
    Polygon round;
    for (int i = 0; i < 40; ++i) {
        const double angle = 2 * std::numbers::pi * i / 40;
        round.push_back({std::cos(angle), std::sin(angle), 0});
    }
    expect_faithful_in_all_positions(round);
}

TEST(TriangulatePolygon, concave) {
    expect_faithful_in_all_positions({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}});  // dart
    expect_faithful_in_all_positions(
        {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});  // L
    expect_faithful_in_all_positions({{0, 0, 0},
                                      {7, 0, 0},
                                      {7, 5, 0},
                                      {6, 5, 0},
                                      {6, 1, 0},
                                      {5, 1, 0},
                                      {5, 5, 0},
                                      {4, 5, 0},
                                      {4, 1, 0},
                                      {3, 1, 0},
                                      {3, 5, 0},
                                      {2, 5, 0},
                                      {2, 1, 0},
                                      {1, 1, 0},
                                      {1, 5, 0},
                                      {0, 5, 0}});  // comb
}

TEST(TriangulatePolygon, spiral) {
    Polygon spiral;
    for (int i = 0; i <= 60; ++i)
        spiral.push_back({(1 + 0.1 * i) * std::cos(0.3 * i), (1 + 0.1 * i) * std::sin(0.3 * i), 0});
    for (int i = 60; i >= 0; --i)
        spiral.push_back({(0.5 + 0.1 * i) * std::cos(0.3 * i), (0.5 + 0.1 * i) * std::sin(0.3 * i), 0});
    expect_faithful(spiral);
    expect_faithful(Polygon(spiral.rbegin(), spiral.rend()));
}

TEST(TriangulatePolygon, collinear_corners_become_corners_of_triangles) {
    expect_faithful_in_all_positions({{0, 0, 0}, {0.1, 0, 0}, {0.3, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    expect_faithful_in_all_positions(
        {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {1, 1, 0}, {0.5, 1, 0}, {0, 1, 0}, {0, 0.5, 0}});
    // An L whose inner corner lies on the line between two others, and corners in a line across.
    expect_faithful_in_all_positions({{0, 0, 0},
                                      {1, 0, 0},
                                      {2, 0, 0},
                                      {2, 1, 0},
                                      {1.5, 1, 0},
                                      {1, 1, 0},
                                      {1, 1.5, 0},
                                      {1, 2, 0},
                                      {0, 2, 0},
                                      {0, 1, 0}});
}

TEST(TriangulatePolygon, random_star_shapes) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.05, 1);
    for (int round = 0; round < 200; ++round) {
        const int corners = 3 + round % 40;
        Polygon star;
        for (int i = 0; i < std::max(corners, 5); ++i) {
            const double angle = 2 * std::numbers::pi * i / std::max(corners, 5), r = radius(random);
            star.push_back({r * std::cos(angle), 3, r * std::sin(angle)});
        }
        SCOPED_TRACE(round);
        expect_faithful(star);
    }
}

TEST(TriangulatePolygon, hole_through_a_slit) {
    // The corners on the slit coincide in pairs, so only areas and orientations are checked.
    const Polygon frame{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                        {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    double sum = 0;
    for (const Triangle& t : triangulate_polygon(frame)) {
        const double part = area_vector(frame, t).z;
        EXPECT_GE(part, 0);
        sum += part;
    }
    EXPECT_DOUBLE_EQ(sum, 8);
}

TEST(TriangulatePolygon, what_is_no_polygon_ends_all_the_same) {
    EXPECT_TRUE(triangulate_polygon({}).empty());
    EXPECT_TRUE(triangulate_polygon({{0, 0, 0}, {1, 0, 0}}).empty());
    EXPECT_EQ(triangulate_polygon(Polygon(6, Vec3{1, 2, 3})).size(), 4U);
    EXPECT_EQ(triangulate_polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(),
              2U);  // crosses itself
    EXPECT_EQ(triangulate_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}}).size(), 2U);  // on a line
}

}  // namespace
}  // namespace stilb::io
