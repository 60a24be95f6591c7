#include "papers/plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stilb/error.h"
#include "support/picture_pixels.h"
#include "support/test_folder.h"

namespace stilb::papers {
namespace {

PngPixels draw(const Plot& plot) {
    const TestFolder folder;
    const auto path = folder / "a.png";
    draw_plot(plot, path);
    return read_png(path);
}

/// A linear axis from 0 to 10.
PlotAxis zero_to_ten() { return {"x", plot::ScaleType::linear, 0.0, 10.0}; }

Plot plot_of(std::vector<Series> series, const PlotAxis& x = zero_to_ten(),
             const PlotAxis& y = zero_to_ten()) {
    return {"", x, {{y, std::move(series), 310}}};
}

/// Only markers.
Series points(std::vector<double> x, std::vector<double> y) {
    Series series{"", std::move(x), std::move(y)};
    series.line = LineStyle::none;
    series.marker = MarkerStyle::circle;
    return series;
}

Spot marker_at(double x, double y, const PlotAxis& axis = zero_to_ten()) {
    return find_colour(draw(plot_of({points({x}, {y})}, axis, axis)), palette_colour(0));
}

TEST(Plot, PutsPointsWhereTheyBelong) {
    // Frames are 620 x 310 units, two pixels each.
    const Spot middle = marker_at(5, 5);
    ASSERT_GT(middle.count, 30);
    EXPECT_NEAR(marker_at(7.5, 5).x - middle.x, 0.25 * 1240, 1);
    EXPECT_NEAR(marker_at(7.5, 5).y, middle.y, 1);
    EXPECT_NEAR(marker_at(5, 10).y - middle.y, -0.5 * 620, 1);
    // Not cut to a quarter on the frame's corner, though ticks run over it.
    EXPECT_GT(marker_at(0, 0).count, 0.6 * middle.count);
    EXPECT_EQ(marker_at(10.5, 5).count, 0);
    EXPECT_EQ(marker_at(NAN, 5).count, 0);
}

TEST(Plot, PutsPointsOnLogarithmicAxes) {
    const PlotAxis axis{"x", plot::ScaleType::logarithmic, 0.01, 100.0};
    const Spot middle = marker_at(1, 1, axis);
    ASSERT_GT(middle.count, 30);
    EXPECT_NEAR(marker_at(10, 0.1, axis).x - middle.x, 0.25 * 1240, 1);
    EXPECT_NEAR(marker_at(10, 0.1, axis).y - middle.y, 0.25 * 620, 1);
    EXPECT_EQ(marker_at(0, 1, axis).count, 0);
    EXPECT_EQ(marker_at(1, -1, axis).count, 0);
}

TEST(Plot, InterruptsLinesAtNaN) {
    const PngPixels whole = draw(plot_of({{"", {0, 2, 4, 6, 8, 10}, {5, 5, 5, 5, 5, 5}}}));
    const PngPixels broken = draw(plot_of({{"", {0, 2, 4, 6, 8, 10}, {5, 5, NAN, 5, 5, 5}}}));
    const Spot all = find_colour(whole, palette_colour(0));
    const Spot rest = find_colour(broken, palette_colour(0));
    EXPECT_NEAR(all.right - all.left, 1240, 4);
    EXPECT_NEAR(rest.count / double(all.count), 0.6, 0.02);
}

TEST(Plot, DrawsBandsBetweenTheirEnds) {
    Series series{"", {0, 10}, {5, 5}, {3, 3}, {8, 8}};
    series.line = LineStyle::none;
    const io::Colour paper = io::grey(1);
    const io::Colour ink = palette_colour(0);
    const auto mixed = [](double top, double below) { return 0.25 * top + 0.75 * below; };
    const io::Colour band{mixed(ink.red, paper.red), mixed(ink.green, paper.green),
                          mixed(ink.blue, paper.blue)};
    const Spot spot = find_colour(draw(plot_of({series})), band);
    // Half of the frame but for the grid lines that shine through.
    EXPECT_NEAR(spot.count / (1240.0 * 620.0), 0.5, 0.02);
    EXPECT_NEAR(spot.y - marker_at(5, 5.5).y, 0, 3);
}

TEST(Plot, DrawsBarsBetweenTheirEnds) {
    Series series{"", {5}, {5}, {2.5}, {7.5}};
    series.line = LineStyle::none;
    series.interval = IntervalStyle::bars;
    const PngPixels pixels = draw(plot_of({series}));
    const Spot spot = find_colour(pixels, palette_colour(0));
    EXPECT_NEAR(spot.y, marker_at(5, 5).y, 1);
    EXPECT_GT(spot.count, 300);  // 2.5 to 7.5 is half of 620 pixels
    EXPECT_LT(spot.right - spot.left, 20);
}

TEST(Plot, BandsDownToZeroFillALogarithmicPanel) {
    Series series{"", {1, 10}, {5, 5}, {0, 0}, {10, 10}};
    series.line = LineStyle::none;
    const PlotAxis axis{"x", plot::ScaleType::logarithmic, 1.0, 10.0};
    const PngPixels pixels = draw(plot_of({series}, axis, axis));
    const Spot white = find_colour(pixels, io::grey(1));
    EXPECT_LT(white.count, pixels.width * pixels.height - 0.95 * 1240 * 620);
}

TEST(Plot, LegendStandsWhereItHidesLeast) {
    // A curve past three corners leaves the lower left.
    const Plot plot = plot_of({{"a name", {0, 5, 9, 9}, {9, 9, 9, 0}}});
    const Spot frame_of_legend = find_colour(draw(plot), io::grey(0.8));
    ASSERT_GT(frame_of_legend.count, 50);
    EXPECT_LT(frame_of_legend.x, 400);
    EXPECT_GT(frame_of_legend.y, 350);
}

TEST(Plot, PanelsShareTheXAxis) {
    Plot plot = plot_of({points({7}, {5})});
    plot.panels.push_back({zero_to_ten(), {points({7}, {5})}, 310});
    plot.panels[1].series[0].colour = palette_colour(1);
    const PngPixels pixels = draw(plot);
    const Spot above = find_colour(pixels, palette_colour(0));
    const Spot below = find_colour(pixels, palette_colour(1));
    EXPECT_NEAR(above.x, below.x, 0.5);
    EXPECT_GT(below.y - above.y, 620);
}

TEST(Plot, WritesSvg) {
    const TestFolder folder;
    const auto path = folder / "a.svg";
    draw_plot(plot_of({{"line", {0, 10}, {0, 10}}}), path);
    const std::string svg = read_text(path);
    EXPECT_EQ(svg.rfind("<?xml", 0), 0u);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(Plot, SaysWhatIsWrong) {
    const Plot unequal = plot_of({{"", {1, 2}, {1}}});
    EXPECT_THROW(draw(unequal), std::invalid_argument);
    const Plot half_interval = plot_of({{"", {1}, {1}, {0}, {}}});
    EXPECT_THROW(draw(half_interval), std::invalid_argument);
    Plot good = plot_of({points({1}, {1})});
    EXPECT_THROW(draw_plot(good, "plot.pdf"), InputError);
    good.x.scale = plot::ScaleType::logarithmic;  // from 0
    EXPECT_THROW(draw(good), InputError);
    good.panels.clear();
    EXPECT_THROW(draw(good), std::invalid_argument);
}

TEST(Plot, DrawsPanelsWithoutData) {
    Plot empty;
    empty.panels.resize(1);
    EXPECT_NO_THROW(draw(empty));
}

}  // namespace
}  // namespace stilb::papers
