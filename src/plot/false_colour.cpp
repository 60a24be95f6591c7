
#include "plot/false_colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "plot/axis.h"
#include "plot/canvas.h"
#include "plot/cell_numbers.h"
#include "plot/false_colour_layout.h"
#include "plot/false_colour_painter.h"

namespace stilb::plot {

namespace {

std::string size_text(const FalseColourPanel& panel) {
    std::string count = fmt::format("{} × {} values", panel.nu, panel.nv);
    if (!has_size(panel)) return count;
    return fmt::format("{:.2f} m × {:.2f} m, {}", panel.width_m, panel.height_m, count);
}

PanelHeading heading_of(const FalseColourPanel& panel) {
    PanelHeading heading{panel.name, size_text(panel), {}};
    if (!panel.subtitle.empty()) heading.lines.push_back(panel.subtitle);
    return heading;
}

std::vector<double> all_values(const FalseColour& picture) {
    std::vector<double> all;
    for (const FalseColourPanel& panel : picture.panels)
        all.insert(all.end(), panel.values.begin(), panel.values.end());
    return all;
}

/// Draws one panel after the other, with their common data.
class PanelPainter {
  public:
    PanelPainter(Canvas& canvas, FalseColourPainter& painter, const FalseColourOptions& options)
        : canvas_(canvas), painter_(painter), options_(options) {}

    void draw(const FalseColourPanel& panel, const PanelHeading& heading, const Tile& tile,
              std::span<const CellNumber> numbers) {
        draw_heading(heading, tile);
        painter_.draw_cells(panel, tile.frame);
        if (options_.isolines) {
            const std::vector<Isoline> isolines = painter_.draw_isolines(panel, tile.frame, numbers);
            if (!options_.numbers) painter_.label_isolines(isolines, tile.frame);
        }
        for (const CellNumber& number : numbers) painter_.draw_number(number);
        canvas_.stroke_rectangle(tile.frame, {kInk, 0.8});
        if (has_size(panel)) draw_lengths(panel, tile.frame);
    }

  private:
    void draw_heading(const PanelHeading& heading, const Tile& tile) {
        Point at{tile.frame.left, tile.box.top + 10};
        canvas_.text(at, heading.name, {.size = kNameSize, .colour = kInk, .weight = Weight::bold});
        const double indent =
            heading.name.empty() ? 0 : text_width(heading.name, kNameSize, Weight::bold) + kNameGap;
        canvas_.text({at.x + indent, at.y}, heading.beside, {.size = kSmallSize, .colour = kFaintInk});
        for (const std::string& line : heading.lines) {
            at.y += kHeadingLine;
            canvas_.text(at, line, {.size = kSmallSize, .colour = kInk});
        }
    }

    void draw_lengths(const FalseColourPanel& panel, const PageRectangle& frame) {
        const auto draw = [&](double length_m, double drawn, Side side) {
            draw_axis(canvas_, Scale(ScaleType::linear, {0, length_m}), length_ticks(length_m, drawn, side),
                      side, frame);
        };
        draw(panel.width_m, frame.width, Side::bottom);
        draw(panel.height_m, frame.height, Side::left);
    }

    Canvas& canvas_;
    FalseColourPainter& painter_;
    const FalseColourOptions& options_;
};

void require_consistency(const FalseColour& picture) {
    if (picture.panels.empty()) throw std::invalid_argument("the false-colour picture has no panels");
    for (const FalseColourPanel& panel : picture.panels) {
        const bool counts_fit =
            panel.nu > 0 && panel.nv > 0 &&
            panel.values.size() / static_cast<std::size_t>(panel.nu) == static_cast<std::size_t>(panel.nv) &&
            panel.values.size() % static_cast<std::size_t>(panel.nu) == 0 &&
            (panel.errors.empty() || panel.errors.size() == panel.values.size());
        if (!counts_fit) throw std::invalid_argument("panel '" + panel.name + "': counts and values differ");
    }
}

/// Where everything stands on the sheet.
struct Sheet {
    std::vector<PanelHeading> headings;
    std::vector<CellNumbers> numbers;  ///< of each panel, where numbers are asked for
    Layout layout;
};

Sheet lay_out_sheet(const FalseColour& picture, const FalseColourOptions& options) {
    Sheet sheet;
    std::vector<CellSize> least_cells(picture.panels.size());
    for (std::size_t i = 0; i < picture.panels.size(); ++i) {
        sheet.headings.push_back(heading_of(picture.panels[i]));
        if (!options.numbers) continue;
        sheet.numbers.emplace_back(picture.panels[i]);
        least_cells[i] = sheet.numbers.back().comfortable_cell();
    }
    const double units_per_m = choose_units_per_m(picture.panels, sheet.headings, least_cells);
    for (std::size_t i = 0; i < sheet.numbers.size(); ++i) {
        sheet.numbers[i].fit_into(cell_size(picture.panels[i], units_per_m));
        const std::string note = sheet.numbers[i].note();
        if (!note.empty()) sheet.headings[i].lines.push_back(note);
    }
    sheet.layout = lay_out(picture.panels, sheet.headings, units_per_m);
    return sheet;
}

}  // namespace

void draw_false_colour(const FalseColour& picture, const FalseColourOptions& options,
                       const std::filesystem::path& path) {
    require_consistency(picture);
    const Scale scale = choose_scale(all_values(picture), options);
    Sheet sheet = lay_out_sheet(picture, options);
    for (Tile& tile : sheet.layout.tiles) move(tile, kSheetMargin, kSheetMargin + kTitleHeight);

    // The bar stands beside the cells, from the top of the first to the bottom of the last.
    const PageRectangle& first = sheet.layout.tiles.front().frame;
    const double content_bottom = kSheetMargin + kTitleHeight + sheet.layout.height;
    double lowest = first.bottom();
    for (const Tile& tile : sheet.layout.tiles) lowest = std::max(lowest, tile.frame.bottom());
    const double title_width = text_width(picture.title, kTitleSize, Weight::bold);
    const double content_width = std::max(sheet.layout.width, first.left - kSheetMargin + title_width);
    const PageRectangle bar{kSheetMargin + content_width + kBarGap, first.top, kBarWidth,
                            std::max(kLeastBarHeight, lowest - first.top)};
    Canvas canvas(path, bar.left + bar_extent(scale) + kSheetMargin,
                  std::max(content_bottom, bar.bottom() + 8) + kSheetMargin - 8);
    canvas.text({first.left, kSheetMargin + kTitleSize}, picture.title,
                {.size = kTitleSize, .colour = kInk, .weight = Weight::bold});
    FalseColourPainter painter(canvas, scale);
    PanelPainter panel_painter(canvas, painter, options);
    for (std::size_t i = 0; i < picture.panels.size(); ++i) {
        const Tile& tile = sheet.layout.tiles[i];
        const std::vector<CellNumber> numbers =
            options.numbers ? sheet.numbers[i].place(tile.frame) : std::vector<CellNumber>{};
        panel_painter.draw(picture.panels[i], sheet.headings[i], tile, numbers);
    }
    painter.draw_bar(bar, picture.unit);
    canvas.save();
}

}  // namespace stilb::plot
