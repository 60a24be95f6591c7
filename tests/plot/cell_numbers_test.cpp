#include "plot/cell_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/picture_pixels.h"
#include "support/test_folder.h"

namespace stilb::plot {
namespace {

/// 12 x 9 cells with three digits each, and one hole.
FalseColourPanel sample_panel() {
    FalseColourPanel panel{"desk", "", 12, 9, 2.4, 1.8, {}};
    for (int i = 0; i < 108; ++i) panel.values.push_back(200 + i);
    panel.values[50] = NAN;
    return panel;
}

constexpr PageRectangle kFrame{10, 20, 600, 450};

TEST(CellNumbers, WritesEveryValueWhereItFits) {
    const FalseColourPanel panel = sample_panel();
    CellNumbers numbers(panel);
    numbers.fit_into({50, 50});
    EXPECT_EQ(numbers.note(), "");
    std::set<std::string> written;
    for (const CellNumber& number : numbers.place(kFrame)) {
        ASSERT_EQ(number.lines.size(), 1u);
        EXPECT_EQ(number.lines[0], std::to_string(int(number.value)));
        written.insert(number.lines[0]);
    }
    EXPECT_EQ(written.size(), 107u);
    EXPECT_EQ(written.count("250"), 0u);
}

TEST(CellNumbers, FitIntoComfortableCells) {
    const FalseColourPanel panel = sample_panel();
    CellNumbers numbers(panel);
    const CellSize cell = numbers.comfortable_cell();
    numbers.fit_into(cell);
    EXPECT_EQ(numbers.note(), "");
    const PageRectangle frame{0, 0, 12 * cell.width, 9 * cell.height};
    for (const CellNumber& number : numbers.place(frame)) {
        EXPECT_NEAR(number.size, 8, 1e-9);
        EXPECT_LT(text_box(number).width, cell.width);
        EXPECT_LT(text_box(number).height, cell.height);
    }
}

TEST(CellNumbers, SaysWhatIsLeftOut) {
    const FalseColourPanel panel = sample_panel();
    CellNumbers numbers(panel);
    const CellSize cell = numbers.comfortable_cell();
    const auto fit = [&](double width, double height) {
        numbers.fit_into({width, height});
        return numbers.place({0, 0, 12 * width, 9 * height});
    };
    EXPECT_EQ(fit(cell.width / 2, cell.height).size(), 6u * 9u - 1);
    EXPECT_EQ(numbers.note(), "numbers of every 2nd column");
    EXPECT_EQ(fit(cell.width / 2, cell.height / 3).size(), 6u * 3u - 1);
    EXPECT_EQ(numbers.note(), "numbers of every 2nd column and 3rd row");
    EXPECT_EQ(fit(cell.width / 3, cell.height / 3).size(), 4u * 3u);
    EXPECT_EQ(numbers.note(), "numbers of every 3rd column and row");
    // As many as there is room for, and none overlap.
    const std::vector<CellNumber> placed = fit(cell.width / 2, cell.height / 2);
    for (const CellNumber& a : placed) {
        for (const CellNumber& b : placed) {
            if (&a == &b) continue;
            const PageRectangle first = text_box(a), second = text_box(b);
            EXPECT_TRUE(first.right() < second.left || second.right() < first.left ||
                        first.bottom() < second.top || second.bottom() < first.top);
        }
    }
}

TEST(CellNumbers, HaveErrorsBelow) {
    FalseColourPanel panel = sample_panel();
    panel.errors.assign(108, 1.34);
    panel.errors[7] = NAN;
    CellNumbers numbers(panel);
    numbers.fit_into({60, 60});
    for (const CellNumber& number : numbers.place(kFrame)) {
        if (number.value == 207) {
            EXPECT_EQ(number.lines, std::vector<std::string>{"207"});
        } else {
            EXPECT_EQ(number.lines, (std::vector<std::string>{std::to_string(int(number.value)), "±1.3"}));
        }
    }
    // Two lines need higher cells.
    EXPECT_GT(numbers.comfortable_cell().height, 1.5 * CellNumbers(sample_panel()).comfortable_cell().height);
}

/// No isoline passes through a number: where the numbers stand, the picture is that without isolines.
TEST(CellNumbers, AreNotCrossedByIsolines) {
    FalseColourPanel panel = sample_panel();
    for (std::size_t i = 0; i < 108; ++i) panel.values[i] = 100 + 40 * std::sin(double(i));
    CellNumbers cell_numbers(panel);
    cell_numbers.fit_into({50, 50});
    const std::vector<CellNumber> numbers = cell_numbers.place(kFrame);
    const auto draw = [&](const std::string& name, bool isolines) {
        const TestFolder folder;
        const auto path = folder / name;
        Canvas canvas(path, 620, 480);
        FalseColourPainter painter(canvas, Scale(ScaleType::linear, {0, 200}));
        painter.draw_cells(panel, kFrame);
        if (isolines) painter.draw_isolines(panel, kFrame, numbers);
        for (const CellNumber& number : numbers) painter.draw_number(number);
        canvas.save();
        return read_png(path);
    };
    const PngPixels plain = draw("plain.png", false), lines = draw("lines.png", true);
    int changed = 0;
    for (std::size_t i = 0; i < plain.rgb.size(); ++i) changed += plain.rgb[i] != lines.rgb[i];
    EXPECT_GT(changed, 5000);
    for (const CellNumber& number : numbers) {
        const PageRectangle box = text_box(number);
        for (int y = int(2 * box.top); y < int(2 * box.bottom()); ++y) {
            for (int x = int(2 * box.left); x < int(2 * box.right()); ++x)
                ASSERT_EQ(plain.at(x, y), lines.at(x, y)) << x << " " << y;
        }
    }
}

}  // namespace
}  // namespace stilb::plot
