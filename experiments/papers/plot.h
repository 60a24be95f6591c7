// Line plots: curves, measured points, intervals; one or more panels above each other on one x axis.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/image/tone_curve.h"
#include "plot/axis.h"

namespace stilb::papers {

// Series: data of plots, drawn as curves, measured points and intervals.

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
    /// Absent: the palette's next colour, by index in the plot or panel.
    std::optional<io::Colour> colour{};
};

/// The palette, also distinguishable by colour-blind readers [Okabe and Ito 2008]; repeats after seven.
io::Colour palette_colour(std::size_t index);

struct PlotAxis {
    std::string label;
    plot::ScaleType scale = plot::ScaleType::linear;
    /// Absent: round numbers about the data.
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

/// Writes a .png or .svg. Throws InputError for an axis that is empty or does not fit, or a file that cannot
/// be written; std::invalid_argument where a series' lists differ in length or there is no panel.
void draw_plot(const Plot& plot, const std::filesystem::path& path);

// Polar plots: values over the angle theta from a surface's normal, in one plane through the normal.

/// A half disk: theta = 0 points upwards, 90 degrees to the right, -90 to the left. The distance from its
/// centre is the value, on a linear scale from 0 to a round number; values below 0 are drawn at the centre.
struct PolarPlot {
    std::string title;
    std::string value_label;     ///< with the unit
    std::vector<Series> series;  ///< x: theta in degrees, -90 to 90; y: the value
};

/// Writes a .png or .svg. Throws InputError for a file that cannot be written; std::invalid_argument where a
/// series' lists differ in length or a theta is out of range.
void draw_polar_plot(const PolarPlot& plot, const std::filesystem::path& path);

}  // namespace stilb::papers
