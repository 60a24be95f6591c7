#include "plot/false_colour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/image/colour_map.h"
#include "stilb/error.h"
#include "support/picture_pixels.h"
#include "support/test_folder.h"

namespace stilb::plot {
namespace {

/// 5 x 5 cells at the scale's lower end but one: cell (u, v) has `value`. Drawn on a scale of 0 to 100.
FalseColour with_one_cell(int u, int v, double value) {
    FalseColourPanel panel{"desk", "", 5, 5, 1, 1, std::vector<double>(25, 0.0)};
    panel.values[static_cast<std::size_t>(5 * v + u)] = value;
    return {"Illuminance", "lx", {panel}};
}

FalseColourOptions zero_to_hundred() {
    FalseColourOptions options;
    options.minimum = 0;
    options.maximum = 100;
    return options;
}

PngPixels draw(const FalseColour& picture, const FalseColourOptions& options) {
    const TestFolder folder;
    const auto path = folder / "a.png";
    draw_false_colour(picture, options, path);
    return read_png(path);
}

io::Colour colour_at(double fraction) { return io::ColourMap().at(fraction); }

/// The cells' part of the picture, which leaves out the colour bar at the right.
int cells_end(const PngPixels& pixels) { return pixels.width * 87 / 100; }

TEST(FalseColour, DrawsUToTheRightAndVUpwards) {
    const PngPixels origin = draw(with_one_cell(0, 0, 60), zero_to_hundred());
    const PngPixels along_u = draw(with_one_cell(4, 0, 60), zero_to_hundred());
    const PngPixels along_v = draw(with_one_cell(0, 4, 60), zero_to_hundred());
    const Spot at_origin = find_colour(origin, colour_at(0.6), cells_end(origin));
    const Spot at_u = find_colour(along_u, colour_at(0.6), cells_end(along_u));
    const Spot at_v = find_colour(along_v, colour_at(0.6), cells_end(along_v));
    const double cell = std::sqrt(double(at_origin.count));  // a square
    ASSERT_GT(cell, 50);
    EXPECT_NEAR((at_u.x - at_origin.x) / cell, 4, 0.1);
    EXPECT_NEAR(at_u.y, at_origin.y, 2);
    EXPECT_NEAR((at_origin.y - at_v.y) / cell, 4, 0.1);
    EXPECT_NEAR(at_v.x, at_origin.x, 2);
}

TEST(FalseColour, GivesEveryValueItsColourOnTheScale) {
    for (const auto& [value, fraction] : {std::pair{35.0, 0.35}, {90.0, 0.9}, {250.0, 1.0}}) {
        const PngPixels pixels = draw(with_one_cell(2, 2, value), zero_to_hundred());
        EXPECT_GT(find_colour(pixels, colour_at(fraction), cells_end(pixels)).count, 2500) << value;
    }
    FalseColourOptions options = zero_to_hundred();
    options.scale = ScaleType::logarithmic;
    options.minimum = 1;
    const PngPixels pixels =
        draw(with_one_cell(2, 2, 10), options);  // the other cells are 0: the lowest colour
    EXPECT_GT(find_colour(pixels, colour_at(0.5), cells_end(pixels)).count, 2500);
    EXPECT_GT(find_colour(pixels, colour_at(0), cells_end(pixels)).count, 50000);
}

TEST(FalseColour, PanelsShareOneScale) {
    FalseColour picture = with_one_cell(2, 2, 100);
    picture.panels.push_back({"other", "", 1, 1, 1, 1, {50}});
    const PngPixels pixels = draw(picture, {});
    EXPECT_GT(find_colour(pixels, colour_at(0.5)).count, 40000);
}

TEST(FalseColour, HatchesCellsWithoutAValue) {
    const PngPixels pixels = draw(with_one_cell(2, 2, NAN), zero_to_hundred());
    const Spot hatched = find_colour(pixels, io::grey(0.86), cells_end(pixels));
    const Spot bars = find_colour(pixels, io::grey(0.62), cells_end(pixels));
    EXPECT_GT(hatched.count, 1000);
    EXPECT_GT(bars.count, 20);
}

TEST(FalseColour, PanelsShareOneScaleOfMetres) {
    // A hall of 4 m x 4 m, a desk of 1 m x 0.5 m, and a strip; and the same after many more desks.
    FalseColour picture{"", "lx", {{"hall", "", 4, 4, 4, 4, std::vector<double>(16, 20)}}};
    picture.panels.push_back({"desk", "", 2, 2, 1, 0.5, std::vector<double>(4, 50)});
    picture.panels.push_back({"strip", "", 10, 1, 5, 0.2, std::vector<double>(10, 70)});
    for (const int more : {0, 12}) {
        for (int i = 0; i < more; ++i)
            picture.panels.push_back({"desk", "", 2, 2, 1, 0.5, std::vector<double>(4, 10)});
        const PngPixels pixels = draw(picture, zero_to_hundred());
        const double per_m2 = find_colour(pixels, colour_at(0.2), cells_end(pixels)).count / 16.;
        EXPECT_GT(per_m2, 60 * 60);
        // The frame's line covers a pixel or two of each side.
        const int desk = find_colour(pixels, colour_at(0.5), cells_end(pixels)).count;
        const int strip = find_colour(pixels, colour_at(0.7), cells_end(pixels)).count;
        EXPECT_NEAR(desk / 0.5, per_m2, 0.08 * per_m2);
        EXPECT_NEAR(strip, per_m2, 0.15 * per_m2);
    }
}

/// White pixels within 200 of the middle of the cells; nothing but numbers is white on cells so dark.
int white_on_cells(const PngPixels& pixels) {
    const Spot cells = find_colour(pixels, colour_at(0.05), cells_end(pixels));
    int white = 0;
    for (int y = int(cells.y) - 200; y < int(cells.y) + 200; ++y) {
        for (int x = int(cells.x) - 200; x < int(cells.x) + 200; ++x) white += pixels.at(x, y) == 0xffffff;
    }
    return white;
}

TEST(FalseColour, WritesNumbersIntoTheCells) {
    FalseColourOptions options = zero_to_hundred();
    const auto panel = [](int count) {
        const auto cells = static_cast<std::size_t>(count) * static_cast<std::size_t>(count);
        return FalseColourPanel{"", "", count, count, 5, 5, std::vector<double>(cells, 5.0)};
    };
    EXPECT_EQ(white_on_cells(draw({"", "lx", {panel(8)}}, options)), 0);
    options.numbers = true;
    EXPECT_GT(white_on_cells(draw({"", "lx", {panel(8)}}, options)), 50);
    // The sheet grows: a number in each of 50 x 50 cells. In 300 x 300 some are left out, but not all.
    const PngPixels many = draw({"", "lx", {panel(50)}}, options);
    EXPECT_GT(many.width, 2000);
    EXPECT_GT(white_on_cells(many), 50);
    const PngPixels most = draw({"", "lx", {panel(300)}}, options);
    EXPECT_LT(most.width, 4200);
    EXPECT_GT(white_on_cells(most), 50);
}

TEST(FalseColour, DrawsIsolinesWhereTheyBelong) {
    FalseColourPanel panel{"", "", 20, 10, 2, 1, {}};
    for (int i = 0; i < 200; ++i) panel.values.push_back((i % 20 + 0.5) * 5);  // 0 to 100 along u
    FalseColourOptions options = zero_to_hundred();
    const PngPixels without = draw({"", "lx", {panel}}, options);
    options.isolines = true;
    const PngPixels with = draw({"", "lx", {panel}}, options);
    ASSERT_EQ(with.width, without.width);
    const Spot first = find_colour(without, colour_at(0.025), cells_end(without));
    const Spot last = find_colour(without, colour_at(0.975), without.width * 9 / 10);
    // Along a horizontal cut above the middle the changed columns gather around the multiples of 20 lx.
    const double per_lux = (last.x - first.x) / 95;
    int changed = 0;
    const int y = int(first.y) - int(15 * per_lux);
    for (int x = int(first.x); x < int(last.x); ++x) {
        if (with.at(x, y) == without.at(x, y)) continue;
        ++changed;
        const double lux = 2.5 + (x - first.x) / per_lux;
        EXPECT_LT(std::abs(lux - 20 * std::round(lux / 20)), 6 / per_lux) << lux;
    }
    EXPECT_GE(changed, 4 * 4);
}

TEST(FalseColour, WritesSvgOfTheSameProportions) {
    const FalseColour picture = with_one_cell(1, 3, 60);
    const PngPixels pixels = draw(picture, zero_to_hundred());
    const TestFolder folder;
    const auto path = folder / "a.svg";
    draw_false_colour(picture, zero_to_hundred(), path);
    const std::string svg = read_text(path);
    EXPECT_EQ(svg.rfind("<?xml", 0), 0u);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    double width = 0, height = 0;
    ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("viewBox"), "viewBox=\"0 0 %lf %lf\"", &width, &height), 2);
    EXPECT_NEAR(pixels.width, 2 * width, 1);
    EXPECT_NEAR(pixels.height, 2 * height, 1);
}

TEST(FalseColour, SaysWhatIsWrong) {
    const FalseColour picture = with_one_cell(0, 0, 60);
    FalseColourOptions options = zero_to_hundred();
    EXPECT_THROW(draw_false_colour(picture, options, "picture.jpg"), InputError);
    EXPECT_THROW(draw_false_colour(picture, options, "/no/such/folder/picture.png"), InputError);
    options.maximum = -1;
    EXPECT_THROW(draw(picture, options), InputError);
    options.maximum = 100;
    options.scale = ScaleType::logarithmic;  // from 0
    EXPECT_THROW(draw(picture, options), InputError);
    FalseColour wrong = picture;
    wrong.panels[0].values.pop_back();
    EXPECT_THROW(draw(wrong, {}), std::invalid_argument);
    EXPECT_THROW(draw({"", "lx", {}}, {}), std::invalid_argument);
    // No .png is so large.
    FalseColour endless = picture;
    endless.panels.insert(endless.panels.end(), 4000, picture.panels[0]);
    EXPECT_THROW(draw(endless, {}), InputError);
}

TEST(FalseColour, DrawsManyPanelsOfAnyShape) {
    FalseColour picture{"All", "lx", {}};
    for (int i = 1; i <= 9; ++i) {
        picture.panels.push_back({"panel", "mean 1 lx", i, 10 - i, 0.3 * i, 5.0 / i, {}});
        picture.panels.back().values.assign(static_cast<std::size_t>(i * (10 - i)), 10.0 * i);
    }
    const PngPixels pixels = draw(picture, {});
    EXPECT_LT(pixels.width, 3000);
    EXPECT_LT(pixels.height, 4000);
}

}  // namespace
}  // namespace stilb::plot
