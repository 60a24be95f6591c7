#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "report/luminaires.h"

namespace stilb::report {
namespace {

/// Rotationally symmetric, by a function of gamma in degrees, every degree.
template <typename Intensity>
PhotometricSolid solid_of(const Intensity& intensity_cd) {
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0};
    for (int gamma = 0; gamma <= 180; ++gamma) {
        grid.polar_deg.push_back(gamma);
        grid.intensity_cd.push_back(intensity_cd(gamma));
    }
    return PhotometricSolid(grid);
}

struct PathPoint {
    double x, y;
};
/// The path of the class with more than two points; the key has one of two.
std::vector<PathPoint> curve(const std::string& markup, const std::string& css_class) {
    const std::string start = "class=\"" + css_class + "\" d=\"";
    std::vector<PathPoint> points;
    for (std::size_t at = markup.find(start); at != std::string::npos && points.size() < 3;
         at = markup.find(start, at + 1)) {
        std::istringstream path(markup.substr(at + start.size()));
        points.clear();
        PathPoint point{};
        for (char command = 0; path >> command >> point.x >> point.y;) points.push_back(point);
    }
    return points;
}

TEST(PolarCurve, OfALambertianLuminaireIsACircle) {
    const double degree = std::numbers::pi / 180;
    const PhotometricSolid solid =
        solid_of([&](int gamma) { return gamma < 90 ? 500 * std::cos(gamma * degree) : 0; });
    const std::string markup = polar_curve(solid).markup();
    const std::vector<PathPoint> points = curve(markup, "c0");
    ASSERT_EQ(points.size(), 181u);  // from -90 to 90 degrees
    // Intensity 1000 / pi cd/klm downwards: a circle through the middle, with its centre below it.
    const PathPoint top = points.front(), bottom = points[90];
    const double radius = (bottom.y - top.y) / 2;
    EXPECT_NEAR(bottom.x, top.x, 0.02);
    for (const PathPoint& point : points)
        EXPECT_NEAR(std::hypot(point.x - top.x, point.y - top.y - radius), radius, 0.05);
    // The rings are labelled to 350 cd/klm, which are 118 pixels.
    EXPECT_NEAR(2 * radius / 118, 1000 / std::numbers::pi / 350, 1e-3);
    EXPECT_NE(markup.find(">cd/klm<"), std::string::npos);
    EXPECT_EQ(markup.find(">180°<"), std::string::npos);
}

TEST(PolarCurve, ShowsTheUpperHalfWhereItShines) {
    const PhotometricSolid solid = solid_of([](int) { return 100.0; });
    const std::string markup = polar_curve(solid).markup();
    const std::vector<PathPoint> points = curve(markup, "c90");
    ASSERT_EQ(points.size(), 361u);
    const double middle_y = (points[180].y + points[0].y) / 2;
    for (const PathPoint& point : points)
        EXPECT_NEAR(std::hypot(point.x - points[180].x, point.y - middle_y), points[180].y - middle_y, 0.05);
    EXPECT_NE(markup.find(">180°<"), std::string::npos);
}

TEST(PolarCurve, DrawsOppositePlanesToOppositeSides) {
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0, 90, 180, 270, 360};
    grid.polar_deg = {0, 90, 180};
    grid.intensity_cd = {100, 100, 0, 100, 0,   0,   100, 0,
                         0,   100, 0, 0,   100, 100, 0};  // bright towards C0 alone
    const std::string markup = polar_curve(PhotometricSolid(grid)).markup();
    const std::vector<PathPoint> points = curve(markup, "c0");
    ASSERT_FALSE(points.empty());
    const double middle = points[points.size() / 2].x;
    EXPECT_GT(points[points.size() / 2 + 45].x - middle, 20);  // C0 to the right
    EXPECT_LT(std::abs(points.front().x - middle), points[points.size() / 2 + 45].x - middle);
}

}  // namespace
}  // namespace stilb::report
