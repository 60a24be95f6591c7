#include "report/drawing.h"

#include <gtest/gtest.h>

#include <array>

namespace stilb::report {
namespace {

constexpr double kPixelsPerMetre = 96 / 0.0254;

TEST(Drawing, ChoosesTheSmallestUsualRatioThatFits) {
    // 7.2 m take 544 pixels at 1 : 50 and 1088 at 1 : 25.
    EXPECT_EQ(usual_ratio(7.2, 6, 620, 760), 50);
    EXPECT_EQ(usual_ratio(7.2, 6, 1100, 1100), 25);
    EXPECT_EQ(usual_ratio(7.2, 60, 620, 760), 500);
    EXPECT_EQ(usual_ratio(0.1, 0.05, 620, 760), 1);
    for (const double length_m : {0.3, 1.0, 4.4, 37.0, 880.0}) {
        const double ratio = usual_ratio(length_m, 0.1, 500, 500);
        EXPECT_LE(length_m * kPixelsPerMetre / ratio, 500.001);
        EXPECT_GT(length_m * kPixelsPerMetre / ratio, 500 / 2.001);
    }
}

TEST(Drawing, FramesAreToScaleWithYUpwards) {
    const ScaledFrame frame{{1, 5}, {-1, 2}, 50, {40, 10}};
    const double scale = kPixelsPerMetre / 50;
    EXPECT_NEAR(frame.rectangle().width, 4 * scale, 1e-9);
    EXPECT_NEAR(frame.rectangle().height, 3 * scale, 1e-9);
    EXPECT_NEAR(frame.at(1, 2).x, 40, 1e-9);
    EXPECT_NEAR(frame.at(1, 2).y, 10, 1e-9);
    EXPECT_NEAR(frame.at(5, -1).x, frame.rectangle().right(), 1e-9);
    EXPECT_NEAR(frame.at(5, -1).y, frame.rectangle().bottom(), 1e-9);
}

TEST(Drawing, WritesShapesAsMarkup) {
    EXPECT_EQ(path_of(std::array<Point, 3>{{{0, 0}, {10.123, 5}, {-0.001, 7}}}), "M0 0L10.12 5L0 7");
    EXPECT_EQ(path_of(std::array<Point, 2>{{{1, 2}, {3, 4}}}, Ends::closed), "M1 2L3 4Z");
    EXPECT_EQ(hexadecimal({1, 0.5, 0}), "#ff8000");
    Drawing drawing(100, 50, "a <drawing>");
    drawing.text("name", {3, 4}, "1 < 2 & 3");
    drawing.path("empty", "");
    EXPECT_EQ(
        drawing.html().markup(),
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\" viewBox=\"0 0 100 50\" "
        "role=\"img\" aria-label=\"a &lt;drawing&gt;\">\n<text class=\"name\" transform=\"translate(3 4) "
        "rotate(0)\" text-anchor=\"start\">1 &lt; 2 &amp; 3</text>\n</svg>");
}

}  // namespace
}  // namespace stilb::report
