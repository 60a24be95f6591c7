#include "plot/false_colour_layout.h"

#include <algorithm>
#include <cmath>

#include "plot/false_colour_painter.h"

namespace stilb::plot {
namespace {

constexpr double kColumnGap = 32;
constexpr double kRowGap = 24;
/// The usual sheet, without bar and margins. It is larger where the scale or the number of panels asks for
/// it.
constexpr double kContentWidth = 860, kContentHeight = 720;
/// No panel is longer.
constexpr double kLongestPanel = 1800;
/// The longest side of all panels is no shorter.
constexpr double kShortestSide = 240;
constexpr double kUnknownCell = 60;
constexpr double kBelowFrame = 4;
/// The ratio of two scales that are tried one after the other.
constexpr double kScaleStep = 1.03;

double longest_side_m(std::span<const FalseColourPanel> panels) {
    double longest = 0;
    for (const FalseColourPanel& panel : panels) {
        if (has_size(panel)) longest = std::max({longest, panel.width_m, panel.height_m});
    }
    return longest;
}

double heading_width(const PanelHeading& heading) {
    double width = text_width(heading.beside, kSmallSize);
    if (!heading.name.empty()) width += text_width(heading.name, kNameSize, Weight::bold) + kNameGap;
    for (const std::string& line : heading.lines) width = std::max(width, text_width(line, kSmallSize));
    return width;
}

/// The space to the left of each frame, for the longest labels of all panels: frames below each other begin
/// at the same place.
double left_extent(std::span<const FalseColourPanel> panels, double units_per_m) {
    double left = 0;
    for (const FalseColourPanel& panel : panels) {
        if (!has_size(panel)) continue;
        const Ticks ticks = length_ticks(panel.height_m, units_per_m * panel.height_m, Side::left);
        left = std::max(left, axis_extent(ticks, Side::left));
    }
    return left;
}

/// A panel on the sheet, at the origin.
Tile make_tile(const FalseColourPanel& panel, const PanelHeading& heading, double heading_width, double left,
               double units_per_m) {
    const auto [cell_width, cell_height] = cell_size(panel, units_per_m);
    const double width = panel.nu * cell_width, height = panel.nv * cell_height;
    double below = kBelowFrame;
    if (has_size(panel)) below += axis_extent(length_ticks(panel.width_m, width, Side::bottom), Side::bottom);
    const double top = 20 + kHeadingLine * static_cast<double>(heading.lines.size());
    const PageRectangle frame{left, top, width, height};
    return {frame, {0, 0, left + std::max(width, heading_width), frame.bottom() + below}};
}

/// Widths of headings cost more than all else and do not depend on the scale.
std::vector<double> heading_widths(std::span<const PanelHeading> headings) {
    std::vector<double> widths;
    for (const PanelHeading& heading : headings) widths.push_back(heading_width(heading));
    return widths;
}

/// Places one tile after the other: below the last one where the row is high enough, else to the right of it,
/// else in a new row.
class Rows {
  public:
    explicit Rows(double widest) : widest_(widest) {}

    void add(Tile tile) {
        const bool is_first = layout_.tiles.empty();
        const bool fits_below = column_bottom_ + kRowGap + tile.box.height <= layout_.height &&
                                column_left_ + tile.box.width <= widest_;
        if (!is_first && fits_below) {
            place(tile, column_left_, column_bottom_ + kRowGap);
            return;
        }
        const double right = is_first ? 0 : column_right_ + kColumnGap;
        if (right + tile.box.width <= widest_) {
            begin_column(tile, right, row_top_);
        } else {
            row_top_ = layout_.height + kRowGap;
            begin_column(tile, 0, row_top_);
        }
    }
    Layout finish() && { return std::move(layout_); }

  private:
    void begin_column(Tile& tile, double left, double top) {
        column_left_ = column_right_ = left;
        place(tile, left, top);
    }
    void place(Tile& tile, double left, double top) {
        move(tile, left, top);
        column_right_ = std::max(column_right_, tile.box.right());
        column_bottom_ = tile.box.bottom();
        layout_.width = std::max(layout_.width, tile.box.right());
        layout_.height = std::max(layout_.height, tile.box.bottom());
        layout_.tiles.push_back(tile);
    }

    double widest_;
    double row_top_ = 0, column_left_ = 0, column_right_ = 0, column_bottom_ = 0;
    Layout layout_;
};

Layout lay_out_rows(std::span<const FalseColourPanel> panels, std::span<const PanelHeading> headings,
                    std::span<const double> widths, double units_per_m) {
    const double left = left_extent(panels, units_per_m);
    std::vector<Tile> tiles;
    double widest = kContentWidth, area = 0;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const Tile& tile =
            tiles.emplace_back(make_tile(panels[i], headings[i], widths[i], left, units_per_m));
        widest = std::max(widest, tile.box.width);
        area += (tile.box.width + kColumnGap) * (tile.box.height + kRowGap);
    }
    // A larger sheet for many panels has the proportions of the usual one.
    widest = std::max(widest, std::sqrt(area * kContentWidth / kContentHeight));
    Rows rows(widest);
    for (const Tile& tile : tiles) rows.add(tile);
    return std::move(rows).finish();
}

}  // namespace

void move(Tile& tile, double x, double y) {
    for (PageRectangle* rectangle : {&tile.frame, &tile.box}) {
        rectangle->left += x;
        rectangle->top += y;
    }
}

bool has_size(const FalseColourPanel& panel) { return panel.width_m > 0 && panel.height_m > 0; }

Ticks length_ticks(double length_m, double drawn, Side side) {
    const double distance = side == Side::left ? 34 : 50;  // labels are wider than high
    Ticks ticks = nice_ticks(Scale(ScaleType::linear, {0, length_m}),
                             std::clamp(static_cast<int>(drawn / distance), 3, 11));
    ticks.minor.clear();
    ticks.major.back().label += " m";
    return ticks;
}

CellSize cell_size(const FalseColourPanel& panel, double units_per_m) {
    if (!has_size(panel)) return {kUnknownCell, kUnknownCell};
    return {units_per_m * panel.width_m / panel.nu, units_per_m * panel.height_m / panel.nv};
}

double choose_units_per_m(std::span<const FalseColourPanel> panels, std::span<const PanelHeading> headings,
                          std::span<const CellSize> least_cells) {
    const double longest_m = longest_side_m(panels);
    if (longest_m == 0) return 1;
    const std::vector<double> widths = heading_widths(headings);
    const double least = kShortestSide / longest_m;
    double units_per_m = kContentWidth / longest_m;
    while (units_per_m > least) {
        const Layout layout = lay_out_rows(panels, headings, widths, units_per_m);
        if (layout.width <= kContentWidth && layout.height <= kContentHeight) break;
        units_per_m /= kScaleStep;
    }
    for (std::size_t i = 0; i < panels.size(); ++i) {
        if (!has_size(panels[i])) continue;
        const auto [width, height] = cell_size(panels[i], 1);
        units_per_m = std::max({units_per_m, least_cells[i].width / width, least_cells[i].height / height});
    }
    return std::min(units_per_m, kLongestPanel / longest_m);
}

Layout lay_out(std::span<const FalseColourPanel> panels, std::span<const PanelHeading> headings,
               double units_per_m) {
    return lay_out_rows(panels, headings, heading_widths(headings), units_per_m);
}

}  // namespace stilb::plot
