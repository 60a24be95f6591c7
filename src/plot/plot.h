// Line plots: curves, measured points, intervals; one or more panels above each other on one x axis.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plot/axis.h"
#include "plot/series.h"

namespace stilb::plot {

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

/// Writes a .png or .svg. Throws InputError for an axis that is empty or does not fit, or a file that cannot
/// be written; std::invalid_argument where a series' lists differ in length or there is no panel.
void draw_plot(const Plot& plot, const std::filesystem::path& path);

}  // namespace stilb::plot
