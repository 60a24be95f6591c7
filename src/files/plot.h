// Line plots: curves, measured points, intervals; one or more panels above each other on one x axis.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/axis.h"
#include "files/colour.h"

namespace stilb {

enum class LineStyle { none, solid, dashed };
enum class MarkerStyle { none, circle, square };
enum class IntervalStyle { band, bars };

/// y over x. A NaN (or, on a logarithmic axis, what is not above 0) interrupts the line.
struct Series {
    std::string name;  ///< in the legend; empty: not in it
    std::vector<double> x, y;
    /// The interval of each y; both empty where there is none.
    std::vector<double> y_low{}, y_high{};
    LineStyle line = LineStyle::solid;
    MarkerStyle marker = MarkerStyle::none;
    IntervalStyle interval = IntervalStyle::band;
    /// Otherwise the palette's next, by position in the panel.
    std::optional<Colour> colour{};
};

struct PlotAxis {
    std::string label;
    ScaleType scale = ScaleType::linear;
    /// Round numbers about the data where absent.
    std::optional<double> minimum{}, maximum{};
};

struct PlotPanel {
    PlotAxis y;
    std::vector<Series> series;
    double height = 360;  ///< of the frame, in units of 1/96 inch
};

/// Panels from top to bottom; `x` is labelled below the last.
struct Plot {
    std::string title;
    PlotAxis x;
    std::vector<PlotPanel> panels;
};

/// The palette's colours, told apart by colour-blind readers too [Okabe and Ito 2008]; repeats after seven.
Colour palette_colour(std::size_t index);

/// Writes a .png or .svg. Throws InputError for an axis that is empty or does not fit, or a file that cannot
/// be written; std::invalid_argument where a series' lists differ in length or there is no panel.
void draw_plot(const Plot& plot, const std::filesystem::path& path);

}  // namespace stilb
