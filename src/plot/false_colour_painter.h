// The common painter of all false-colour pictures.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/image/colour_map.h"
#include "plot/axis.h"
#include "plot/canvas.h"
#include "plot/false_colour.h"

namespace stilb::plot {

inline constexpr double kSheetMargin = 24;
inline constexpr double kTitleSize = 17;
inline constexpr double kTitleHeight = 36;
inline constexpr double kNameSize = 12.5;
inline constexpr double kSmallSize = 10.5;
inline constexpr double kBarWidth = 18;
inline constexpr double kBarGap = 30;
inline constexpr double kLeastBarHeight = 180;

/// The scale of the options; open ends are chosen from all the values.
Scale choose_scale(std::span<const double> values, const FalseColourOptions& options);

/// Width of the colour bar with its labels.
double bar_extent(const Scale& scale);

/// The colour of one value of the panel.
PageRectangle cell_in(const PageRectangle& frame, const FalseColourPanel& panel, int u, int v);

struct Isoline {
    std::vector<Point> points;  ///< on the sheet
    std::string label;
};

/// A number in the middle of its cell, perhaps with a second line below.
struct CellNumber {
    Point center;
    double value = 0;  ///< of the cell, for the colours
    std::vector<std::string> lines;
    double size = 0;  ///< of the first line; further ones are smaller
};

/// The place that the number takes.
PageRectangle text_box(const CellNumber& number);

/// Draws panels' values into frames: row v = 0 at the bottom, a NaN as hatching.
class FalseColourPainter {
  public:
    FalseColourPainter(Canvas& canvas, const Scale& scale);

    void draw_cells(const FalseColourPanel& panel, const PageRectangle& frame);
    /// Isolines at the bar's labelled values except its ends, interrupted at the numbers. Specks, shorter
    /// than the height of a label, are left out.
    std::vector<Isoline> draw_isolines(const FalseColourPanel& panel, const PageRectangle& frame,
                                       std::span<const CellNumber> numbers);
    void label_isolines(std::span<const Isoline> isolines, const PageRectangle& frame);
    void draw_number(const CellNumber& number);
    void draw_bar(const PageRectangle& bar, const std::string& unit);

  private:
    void draw_hatching(const PageRectangle& place);
    std::vector<Isoline> find_lines(const FalseColourPanel& panel, const PageRectangle& frame) const;

    Canvas& canvas_;
    Scale scale_;
    Ticks ticks_;
    io::ColourMap map_;
};

}  // namespace stilb::plot
