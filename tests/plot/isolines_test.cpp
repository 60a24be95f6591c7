#include "plot/isolines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stilb::plot {
namespace {

/// Values at cell centres.
template <typename Field>
std::vector<double> sampled(int nu, int nv, Field field) {
    std::vector<double> values;
    for (int v = 0; v < nv; ++v) {
        for (int u = 0; u < nu; ++u) values.push_back(field(u + 0.5, v + 0.5));
    }
    return values;
}

double length_of(const std::vector<Point>& line) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        length += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    }
    return length;
}

TEST(Isolines, OfAPlaneAreStraightFromEdgeToEdge) {
    const auto values = sampled(6, 4, [](double x, double y) { return 2 * x + y; });
    const auto lines = find_isolines(values, 6, 4, 7.3);
    ASSERT_EQ(lines.size(), 1u);
    for (const Point& point : lines[0]) EXPECT_NEAR(2 * point.x + point.y, 7.3, 1e-12);
    // x from 1.65 at y = 4 to 3.65 at y = 0.
    EXPECT_NEAR(length_of(lines[0]), std::hypot(2, 4), 1e-12);
}

TEST(Isolines, OfAConeAreClosedCircles) {
    const auto values = sampled(40, 40, [](double x, double y) { return -std::hypot(x - 20, y - 19.7); });
    const auto lines = find_isolines(values, 40, 40, -11.2);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].front().x, lines[0].back().x);
    EXPECT_EQ(lines[0].front().y, lines[0].back().y);
    for (const Point& point : lines[0]) EXPECT_NEAR(std::hypot(point.x - 20, point.y - 19.7), 11.2, 0.02);
    EXPECT_NEAR(length_of(lines[0]), 2 * M_PI * 11.2, 0.2);
}

TEST(Isolines, OfASaddleDoNotCross) {
    const auto values = sampled(2, 2, [](double x, double y) { return (x - 1) * (y - 1); });  // +-0.25
    // Above the saddle's value the high corners stand apart, below it the low ones.
    for (const double level : {0.1, -0.1}) {
        const auto lines = find_isolines(values, 2, 2, level);
        ASSERT_EQ(lines.size(), 2u) << level;
        for (const auto& line : lines) {
            for (const Point& point : line) {
                const double side = (point.x - 1) * (point.y - 1);
                EXPECT_GT(side * level, 0) << point.x << " " << point.y;
            }
        }
    }
}

TEST(Isolines, LeaveHolesAtNaN) {
    auto values = sampled(8, 8, [](double x, double) { return x; });
    values[3 * 8 + 4] = NAN;  // centre (4.5, 3.5)
    const auto lines = find_isolines(values, 8, 8, 4.2);
    ASSERT_EQ(lines.size(), 2u);
    for (const auto& line : lines) {
        for (const Point& point : line) {
            EXPECT_NEAR(point.x, 4.2, 1e-12);
            EXPECT_FALSE(point.y > 2.6 && point.y < 4.4) << point.y;
        }
    }
}

TEST(Isolines, OfOneCellOrAConstantAreNone) {
    EXPECT_TRUE(find_isolines(std::vector<double>{5}, 1, 1, 5).empty());
    EXPECT_TRUE(find_isolines(std::vector<double>(12, 5.0), 4, 3, 4).empty());
}

TEST(LabelPlacer, KeepsLabelsApartAndInside) {
    LabelPlacer placer({0, 0, 200, 100});
    std::vector<LabelPlace> places;
    for (int i = 0; i < 12; ++i) {
        const double y = 3 + 8.5 * i;
        const std::vector<Point> line{{0, y}, {100, y + 1}, {200, y}};
        if (const auto place = placer.place(line, 30)) places.push_back(*place);
    }
    ASSERT_GE(places.size(), 3u);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Point& a = places[i].center;
        EXPECT_TRUE(a.x >= 15 && a.x <= 185 && a.y >= 15 && a.y <= 85) << a.x << " " << a.y;
        for (std::size_t j = 0; j < i; ++j) {
            const Point& b = places[j].center;
            EXPECT_GE(std::hypot(a.x - b.x, a.y - b.y), 30);
        }
    }
}

TEST(LabelPlacer, ReadsAlongTheLineAndNeverUpsideDown) {
    LabelPlacer placer({0, 0, 200, 200});
    const std::vector<Point> line{{180, 20}, {20, 180}};
    const auto place = placer.place(line, 30);
    ASSERT_TRUE(place.has_value());
    EXPECT_NEAR(place->angle_rad, -M_PI / 4, 1e-12);
    EXPECT_NEAR(place->center.x, 100, 1e-9);
    EXPECT_FALSE(LabelPlacer({0, 0, 200, 200}).place(std::vector<Point>{{90, 90}, {110, 90}}, 30));
}

}  // namespace
}  // namespace stilb::plot
