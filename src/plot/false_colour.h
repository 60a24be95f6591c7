// False-colour pictures of grids.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plot/axis.h"

namespace stilb::plot {

/// One grid. Row v = 0 is drawn at the bottom, u to the right.
struct FalseColourPanel {
    std::string name;
    std::string subtitle{};  ///< one line under the name; may be empty
    int nu = 1, nv = 1;
    double width_m = 0, height_m = 0;  ///< along u and v; both 0 where unknown: cells are square then
    std::vector<double> values;        ///< nu x nv, u fastest; NaN is drawn as a hatched cell
    std::vector<double> errors{};      ///< of each value, to stand below its number after a ±; may be empty

    std::size_t index_of(int u, int v) const {
        return static_cast<std::size_t>(v) * static_cast<std::size_t>(nu) + static_cast<std::size_t>(u);
    }
    double value_at(int u, int v) const { return values[index_of(u, v)]; }
};

struct FalseColour {
    std::string title;
    std::string unit;
    std::vector<FalseColourPanel> panels;
};

struct FalseColourOptions {
    ScaleType scale = ScaleType::linear;
    /// Ends of the scale, common to all panels; absent: round numbers about the data (on a logarithmic
    /// scale at most four decades). Values beyond get the end's colour.
    std::optional<double> minimum, maximum;
    /// Lines at the labelled values inside the colour bar. They are labelled unless cells show their values.
    bool isolines = false;
    /// The value in each cell, with its error below where the panel has errors. The sheet grows so that they
    /// fit; where even the largest sheet is too small, every second, third ... column or row has numbers, and
    /// the panel's heading says so. Isolines leave the numbers free.
    bool numbers = false;
    /// Measured grids: half of the 95 % interval, after a ± in headings and below numbers.
    bool errors = false;
};

/// All panels are drawn at one scale of metres. Writes a .png or .svg. Throws InputError for a scale that is
/// empty or does not fit, or a file that cannot be written; std::invalid_argument for a panel whose counts,
/// sizes and values do not agree.
void draw_false_colour(const FalseColour& picture, const FalseColourOptions& options,
                       const std::filesystem::path& path);

}  // namespace stilb::plot
