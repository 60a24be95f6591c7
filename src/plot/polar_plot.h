// Polar plots: values over the angle theta from a surface's normal, in one plane through the normal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plot/series.h"

namespace stilb::plot {

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

}  // namespace stilb::plot
