#include "report/plane_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/image/colour_map.h"
#include "io/results/results_text.h"
#include "plot/cell_numbers.h"
#include "report/drawing.h"

namespace stilb::report {
namespace {

constexpr double kMostWidth = 600, kMostHeight = 470;
/// Cells of that size have readable numbers; small planes are no larger.
constexpr double kCellWidth = 40, kCellHeight = 34, kLeastSide = 150;

/// The largest usual scale at which the plane fits on a page and its cells are not larger than numbers need.
double ratio_of(const plot::FalseColourPanel& panel) {
    return usual_ratio(panel.width_m, panel.height_m,
                       std::clamp(kCellWidth * panel.nu, kLeastSide, kMostWidth),
                       std::clamp(kCellHeight * panel.nv, kLeastSide, kMostHeight));
}

/// The cells of each colour as one path.
void draw_cells(Drawing& drawing, const plot::FalseColourPanel& panel, const plot::PageRectangle& frame,
                const plot::Scale& scale, const io::ColourMap& colours) {
    struct Cells {
        io::Colour colour;
        std::string path;
    };
    std::map<std::string, Cells> of_colour;
    for (int v = 0; v < panel.nv; ++v) {
        for (int u = 0; u < panel.nu; ++u) {
            const double value = panel.value_at(u, v);
            if (std::isnan(value)) continue;
            const io::Colour colour = colours.at(scale.fraction_of(value));
            Cells& cells = of_colour[hexadecimal(colour)];
            cells.colour = colour;
            const plot::PageRectangle cell = plot::cell_in(frame, panel, u, v);
            cells.path += fmt::format("M{} {}h{}v{}h{}z", pixels(cell.left), pixels(cell.top),
                                      pixels(cell.width), pixels(cell.height), pixels(-cell.width));
        }
    }
    for (const auto& [name, cells] : of_colour) drawing.filled_path("cells", cells.path, cells.colour);
}

std::string outline_path(const MeasuredPlane& plane, const ScaledFrame& frame) {
    std::string path;
    for (const std::vector<Vec3>& ring : outlines_of(plane.result->sensor)) {
        std::vector<Point> points;
        for (const Vec3& corner : ring) {
            const auto [x, y] = plane.to_plane(corner);
            points.push_back(frame.at(x, y));
        }
        path += path_of(points, Ends::closed);
    }
    return path;
}

std::string caption(const MeasuredPlane& plane, double ratio, const std::string& note) {
    const SensorResult& result = *plane.result;
    std::string words = fmt::format("{}; {:.3g} m × {:.3g} m", io::size_text(result.sensor),
                                    plane.panel.width_m, plane.panel.height_m);
    if (plane.is_horizontal()) words += fmt::format(" at z = {:.4g} m", plane.corner.z);
    words += fmt::format("; 1 : {:g} in print", ratio);
    if (!note.empty()) words += "; " + note;
    return words + ".";
}

Html figure_of(const MeasuredPlane& plane, const plot::Scale& scale, const io::ColourMap& colours) {
    const plot::FalseColourPanel& panel = plane.panel;
    const double ratio = ratio_of(panel);
    const ScaledFrame frame{{0, panel.width_m}, {0, panel.height_m}, ratio, {kAxisLeft, kDrawingMargin}};
    const plot::PageRectangle box = frame.rectangle();
    Drawing drawing(box.right() + kDrawingMargin, box.bottom() + kAxisBelow,
                    fmt::format("Illuminances of {}", panel.name));
    draw_cells(drawing, panel, box, scale, colours);
    plot::CellNumbers numbers(panel);
    numbers.fit_into(plot::cell_size(panel, frame.pixels_per_m()));
    for (const plot::CellNumber& number : numbers.place(box)) {
        drawing.number(number.center, number.lines.front(), number.size,
                       readable_on(colours.at(scale.fraction_of(number.value))));
    }
    drawing.path("outline", outline_path(plane, frame));
    draw_metres(drawing, frame);
    return element("figure", {{"class", "plane"}},
                   element("h3", name_text(panel.name)) + drawing.html() +
                       element("figcaption", caption(plane, ratio, numbers.note()))) +
           raw("\n");
}

Html colour_bar(const plot::Scale& scale, const io::ColourMap& colours) {
    constexpr int kSteps = 128;
    constexpr double kWidth = 420, kHeight = 12;
    Drawing drawing(kAxisLeft + kWidth + 60, kDrawingMargin + kHeight + kAxisBelow,
                    "The colours of illuminances");
    for (int i = 0; i < kSteps; ++i) {
        drawing.filled_path(
            "cells",
            fmt::format("M{} {}h{}v{}h{}z", pixels(kAxisLeft + kWidth * i / kSteps), pixels(kDrawingMargin),
                        pixels(kWidth / kSteps), pixels(kHeight), pixels(-kWidth / kSteps)),
            colours.at((i + 0.5) / kSteps));
    }
    for (const auto& [value, label] : scale_ticks(scale)) {
        const double x = kAxisLeft + kWidth * scale.fraction_of(value);
        drawing.line("tick", {x, kDrawingMargin + kHeight}, {x, kDrawingMargin + kHeight + 4});
        drawing.text("axis", {x, kDrawingMargin + kHeight + 14}, label, Drawing::Anchor::middle);
    }
    drawing.text("axis", {kAxisLeft + kWidth + 16, kDrawingMargin + kHeight}, "lx");
    return element(
        "figure", {{"class", "colours"}},
        drawing.html() +
            element("figcaption", "All areas in the same colours, each at a scale at which it can be read."));
}

}  // namespace

Html plane_pictures(std::span<const MeasuredPlane> planes) {
    if (planes.empty()) return {};
    const plot::Scale scale = common_scale(planes);
    const io::ColourMap colours;
    Html html = colour_bar(scale, colours);
    for (const MeasuredPlane& plane : planes) html += figure_of(plane, scale, colours);
    return html;
}

}  // namespace stilb::report
