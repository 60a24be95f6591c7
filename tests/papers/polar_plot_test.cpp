#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "papers/plot.h"
#include "stilb/error.h"
#include "support/picture_pixels.h"
#include "support/test_folder.h"

namespace stilb::papers {
namespace {

PngPixels drawn_polar(const PolarPlot& plot) {
    const TestFolder folder;
    const auto path = folder / "a.png";
    draw_polar_plot(plot, path);
    return read_png(path);
}

/// Markers in the palette's first colour, on a scale to 10: the last one, of another colour, stands there.
Spot polar_marker_at(double theta_deg, double value) {
    const auto points = [](double x, double y) {
        Series series{"", {x}, {y}};
        series.line = LineStyle::none;
        series.marker = MarkerStyle::circle;
        return series;
    };
    return find_colour(drawn_polar({"", "", {points(theta_deg, value), points(-45, 10)}}), palette_colour(0));
}

constexpr double kRadius = 620;  // in pixels

TEST(PolarPlot, PutsPointsWhereTheyBelong) {
    const Spot centre = polar_marker_at(0, 0);
    ASSERT_GT(centre.count, 30);
    for (const double theta_deg : {-90.0, -30.0, 0.0, 60.0, 90.0}) {
        const double theta = theta_deg * std::numbers::pi / 180;
        const Spot spot = polar_marker_at(theta_deg, 5);
        EXPECT_NEAR(spot.x - centre.x, kRadius / 2 * std::sin(theta), 1) << theta_deg;
        EXPECT_NEAR(spot.y - centre.y, -kRadius / 2 * std::cos(theta), 1) << theta_deg;
    }
    EXPECT_NEAR(polar_marker_at(40, -1).x, centre.x, 1);
    EXPECT_EQ(polar_marker_at(40, NAN).count, 0);
}

TEST(PolarPlot, EqualValuesAreAnArc) {
    Series series{"", {}, {}};
    for (int theta_deg = -90; theta_deg <= 90; ++theta_deg) {
        series.x.push_back(theta_deg);
        series.y.push_back(5);
    }
    const Spot arc = find_colour(drawn_polar({"", "", {series, {"", {0}, {10}}}}), palette_colour(0));
    EXPECT_NEAR(arc.right - arc.left, kRadius, 6);
    // The lines' 1.7 units, 3.4 pixels, less their soft edges.
    EXPECT_NEAR(arc.count, std::numbers::pi * kRadius / 2 * 2.6, 0.25 * arc.count);
}

TEST(PolarPlot, DrawsBandsBetweenTheirEnds) {
    Series series{"", {}, {}};
    for (int theta_deg = -90; theta_deg <= 90; ++theta_deg) {
        series.x.push_back(theta_deg);
        series.y.push_back(7);
        series.y_low.push_back(5);
        series.y_high.push_back(10);
    }
    series.line = LineStyle::none;
    const io::Colour ink = palette_colour(0);
    const auto on_paper = [](double component) { return 0.25 * component + 0.75; };
    const io::Colour band{on_paper(ink.red), on_paper(ink.green), on_paper(ink.blue)};
    const double expected = std::numbers::pi / 2 * kRadius * kRadius * (1 - 0.25);
    // But for the grid that shines through.
    EXPECT_NEAR(find_colour(drawn_polar({"", "", {series}}), band).count / expected, 1, 0.06);
}

TEST(PolarPlot, TakesTheRoomThatItsTextsNeed) {
    const PolarPlot plain{"", "", {{"", {0, 30}, {1, 2}}}};
    PolarPlot with_texts = plain;
    with_texts.title = "A title";
    with_texts.series[0].name = "a curve";
    const PngPixels without = drawn_polar(plain), with = drawn_polar(with_texts);
    EXPECT_GT(with.height, without.height + 60);
    // The curve's swatch in the legend: 28 units of a line 1.7 wide.
    EXPECT_GT(find_colour(with, palette_colour(0)).count,
              find_colour(without, palette_colour(0)).count + 100);
}

TEST(PolarPlot, WritesSvg) {
    const TestFolder folder;
    const auto path = folder / "a.svg";
    draw_polar_plot({"", "L", {{"line", {-90, 90}, {1, 2}}}}, path);
    const std::string svg = read_text(path);
    EXPECT_EQ(svg.rfind("<?xml", 0), 0u);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(PolarPlot, SaysWhatIsWrong) {
    EXPECT_THROW(drawn_polar({"", "", {{"", {1, 2}, {1}}}}), std::invalid_argument);
    EXPECT_THROW(drawn_polar({"", "", {{"", {91}, {1}}}}), std::invalid_argument);
    EXPECT_THROW(drawn_polar({"", "", {{"", {NAN}, {1}}}}), std::invalid_argument);
    EXPECT_THROW(draw_polar_plot({"", "", {}}, "polar.pdf"), InputError);
}

TEST(PolarPlot, DrawsNothingButItsFrameWithoutData) { EXPECT_NO_THROW(drawn_polar({})); }

}  // namespace
}  // namespace stilb::papers
