// The layout of the panels of a false-colour picture: all at one scale of metres.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "plot/axis.h"
#include "plot/canvas.h"
#include "plot/false_colour.h"

namespace stilb::plot {

/// Whether the panel's size in metres is known.
bool has_size(const FalseColourPanel& panel);

/// Lengths along the left or bottom side, which is `drawn` long on the sheet; the last one names the unit.
Ticks length_ticks(double length_m, double drawn, Side side);

/// What stands above a panel: its name with `beside` to the right, and lines below.
struct PanelHeading {
    std::string name, beside;
    std::vector<std::string> lines;
};

inline constexpr double kNameGap = 12;
inline constexpr double kHeadingLine = 17;

/// The layout of a panel: the frame holds the cells, the box also the heading and the axes.
struct Tile {
    PageRectangle frame;
    PageRectangle box;
};

void move(Tile& tile, double x, double y);

struct Layout {
    std::vector<Tile> tiles;
    double width = 0, height = 0;
};

/// The size of one cell of the panel on the sheet, `units_per_m` to the metre. Cells of unknown size are
/// squares of a fixed size.
struct CellSize {
    double width = 0, height = 0;
};
CellSize cell_size(const FalseColourPanel& panel, double units_per_m);

/// The largest scale at which rows of panels fill a sheet of the usual size. It is larger, up to a sheet of
/// 1800 units, where cells otherwise were smaller than `least_cell` (one for each panel).
double choose_units_per_m(std::span<const FalseColourPanel> panels, std::span<const PanelHeading> headings,
                          std::span<const CellSize> least_cells);

/// Panels in rows, from (0, 0); small ones below each other beside a high one.
Layout lay_out(std::span<const FalseColourPanel> panels, std::span<const PanelHeading> headings,
               double units_per_m);

}  // namespace stilb::plot
