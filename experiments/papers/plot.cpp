
#include "papers/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <span>
#include <stdexcept>

#include "papers/series_drawing.h"
#include "plot/axis.h"
#include "plot/canvas.h"

namespace stilb::papers {

namespace {

constexpr double kWidth = 620;  // of the frames
constexpr double kPanelGap = 16;
/// Rounding of a point on the frame's edge.
constexpr double kEdgeSlack = 1e-6;
/// The limit of off-scale points, in frame heights, which Cairo's fixed point numbers can
/// represent.
constexpr double kFarthest = 8;

plot::Scale make_scale(const PlotAxis& axis, const std::vector<double>& values) {
    const plot::AxisRange range = nice_range(axis.scale, values);
    return plot::Scale(axis.scale, {axis.minimum.value_or(range.low), axis.maximum.value_or(range.high)});
}

plot::Scale x_scale_of(const Plot& drawn) {
    std::vector<double> values;
    for (const PlotPanel& panel : drawn.panels) {
        for (const Series& series : panel.series) {
            values.insert(values.end(), series.x.begin(), series.x.end());
        }
    }
    return make_scale(drawn.x, values);
}

plot::Scale y_scale_of(const PlotPanel& panel) {
    std::vector<double> values;
    for (const Series& series : panel.series) {
        for (const auto* list : {&series.y, &series.y_low, &series.y_high}) {
            values.insert(values.end(), list->begin(), list->end());
        }
    }
    return make_scale(panel.y, values);
}

void require_consistency(const Plot& drawn) {
    if (drawn.panels.empty()) throw std::invalid_argument("the plot has no panels");
    for (const PlotPanel& panel : drawn.panels) require_consistency(panel.series);
}

/// The scales and the position of one panel.
struct PanelFrame {
    plot::Scale x, y;
    plot::Ticks x_ticks, y_ticks;
    PageRectangle place;

    PanelFrame(const plot::Scale& x_scale, const plot::Scale& y_scale, double height)
        : x(x_scale),
          y(y_scale),
          x_ticks(nice_ticks(x, static_cast<int>(kWidth / 60))),
          y_ticks(nice_ticks(y, std::max(4, static_cast<int>(height / 38)))),
          place{0, 0, kWidth, height} {}

    /// NaN where the value has no position on the axis.
    Point at(double x_value, double y_value) const {
        const double u = x.fraction_of(x_value);
        const double v = y.fraction_of(y_value);
        return {
            std::isfinite(u) ? place.left + std::clamp(u, -kFarthest, kFarthest) * place.width : NAN,
            std::isfinite(v) ? place.bottom() - std::clamp(v, -kFarthest, kFarthest) * place.height : NAN};
    }

    /// Whether the position lies within the frame's width.
    bool has_column(const Point& point) const {
        return point.x >= place.left - kEdgeSlack && point.x <= place.right() + kEdgeSlack;
    }

    /// Lower ends without a logarithm go down off the frame.
    double low_end(double y_value) const {
        return y.type() == plot::ScaleType::logarithmic && y_value <= 0 ? y.value_at(-1) : y_value;
    }
};

void draw_grid_lines(Canvas& canvas, const PanelFrame& frame) {
    const PageRectangle& place = frame.place;
    for (const plot::Tick& tick : frame.x_ticks.major) {
        const double x = position_along(frame.x, plot::Side::bottom, place, tick.value);
        canvas.line({x, place.top}, {x, place.bottom()}, {kGridColour, 0.8});
    }
    for (const plot::Tick& tick : frame.y_ticks.major) {
        const double y = position_along(frame.y, plot::Side::left, place, tick.value);
        canvas.line({place.left, y}, {place.right(), y}, {kGridColour, 0.8});
    }
}

/// The corner of the frame where the legend hides least.
PageRectangle place_legend(std::span<const PlacedSeries> all, const PageRectangle& frame) {
    constexpr double kInset = 10;
    const PageRectangle box = legend_box(all);
    PageRectangle best;
    int least = -1;
    for (const double top : {frame.top + kInset, frame.bottom() - kInset - box.height}) {
        for (const double left : {frame.right() - kInset - box.width, frame.left + kInset}) {
            const PageRectangle area{left, top, box.width, box.height};
            const int crowd = crowd_within(area, all);
            if (least >= 0 && crowd >= least) continue;
            least = crowd;
            best = area;
        }
    }
    return best;
}

void draw_panel(Canvas& canvas, const PlotPanel& panel, const PanelFrame& frame) {
    const PageRectangle& place = frame.place;
    std::vector<PlacedSeries> all;
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        all.push_back(place_series(panel.series[i], i, frame));
    }
    draw_grid_lines(canvas, frame);
    canvas.clipped(place, [&] {
        for (const PlacedSeries& placed : all) draw_areas(canvas, placed);
    });
    canvas.stroke_rectangle(place, {plot::kInk, 0.8});
    const PageRectangle around{place.left - kMarkerReach, place.top - kMarkerReach,
                               place.width + 2 * kMarkerReach, place.height + 2 * kMarkerReach};
    canvas.clipped(around, [&] {
        const auto is_within = [&](const Point& point) { return frame.has_column(point); };
        for (const PlacedSeries& placed : all) draw_points(canvas, placed, is_within);
    });
    draw_legend(canvas, all, place_legend(all, place));
    draw_axis(canvas, frame.x, frame.x_ticks, plot::Side::bottom, place);
    draw_axis(canvas, frame.y, frame.y_ticks, plot::Side::left, place);
    canvas.text({kMargin + kLabelSize, place.center().y}, panel.y.label,
                {.size = kLabelSize,
                 .colour = plot::kInk,
                 .horizontal = plot::HorizontalPart::center,
                 .angle_rad = plot::kUpwards});
}

}  // namespace

void draw_plot(const Plot& drawn, const std::filesystem::path& path) {
    require_consistency(drawn);
    const plot::Scale x = x_scale_of(drawn);
    std::vector<PanelFrame> frames;
    double extent = 0;
    for (const PlotPanel& panel : drawn.panels) {
        frames.emplace_back(x, y_scale_of(panel), panel.height);
        extent = std::max(extent, axis_extent(frames.back().y_ticks, plot::Side::left));
    }
    double bottom = kMargin + (drawn.title.empty() ? 0 : kPlotTitleSize + 14);
    for (PanelFrame& frame : frames) {
        frame.place.left = kMargin + kLabelSize + 12 + extent;
        frame.place.top = bottom;
        bottom = frame.place.bottom() + kPanelGap;
    }
    const PageRectangle& last = frames.back().place;
    const double x_label =
        last.bottom() + axis_extent(frames.back().x_ticks, plot::Side::bottom) + 8 + kLabelSize;

    Canvas canvas(path, last.right() + kMargin + 8, x_label + kMargin);
    canvas.text({last.left, kMargin + kPlotTitleSize}, drawn.title,
                {.size = kPlotTitleSize, .colour = plot::kInk, .weight = plot::Weight::bold});
    // Only the lowest panel's x axis carries numbers.
    for (PanelFrame& frame : std::span(frames).first(frames.size() - 1)) {
        for (plot::Tick& tick : frame.x_ticks.major) tick.label.clear();
    }
    for (std::size_t i = 0; i < frames.size(); ++i) draw_panel(canvas, drawn.panels[i], frames[i]);
    canvas.text({last.center().x, x_label}, drawn.x.label,
                {.size = kLabelSize, .colour = plot::kInk, .horizontal = plot::HorizontalPart::center});
    canvas.save();
}

namespace {

constexpr double kRadius = 310;  // of the half disk
constexpr int kSpokeStep_deg = 15;
constexpr int kLabelStep_deg = 30;
/// Between the disk and the angles around it.
constexpr double kAngleGap = 14;
constexpr double kAngleRoom = 44;
constexpr double kLegendGap = 16;

plot::Scale scale_of(const std::vector<Series>& all) {
    std::vector<double> values{0};
    for (const Series& series : all) {
        for (const auto* list : {&series.y, &series.y_low, &series.y_high}) {
            for (const double value : *list) values.push_back(std::max(value, 0.0));
        }
    }
    return plot::Scale(plot::ScaleType::linear, nice_range(plot::ScaleType::linear, values));
}

void require_angles(const std::vector<Series>& all) {
    for (const Series& series : all) {
        for (const double theta_deg : series.x) {
            if (std::abs(theta_deg) <= 90) continue;
            throw std::invalid_argument(fmt::format("series '{}': theta = {} is outside of -90 to 90 degrees",
                                                    series.name, theta_deg));
        }
    }
}

Point around(const Point& centre, double theta_deg, double radius) {
    const double theta = theta_deg * std::numbers::pi / 180;
    return {centre.x + radius * std::sin(theta), centre.y - radius * std::cos(theta)};
}

struct PolarFrame {
    plot::Scale scale;
    Point centre;

    Point at(double theta_deg, double value) const {
        if (!std::isfinite(value)) return {NAN, NAN};
        return around(centre, theta_deg, kRadius * std::max(0.0, scale.fraction_of(value)));
    }
    double low_end(double value) const { return value; }
    /// The axis of the right half, below which the scale is drawn.
    PageRectangle right_half() const { return {centre.x, centre.y - kRadius, kRadius, kRadius}; }
};

void draw_ring(Canvas& canvas, const Point& centre, double radius, const Stroke& stroke) {
    std::vector<Point> arc;
    for (int theta_deg = -90; theta_deg <= 90; ++theta_deg) arc.push_back(around(centre, theta_deg, radius));
    canvas.polyline(arc, stroke);
}

void draw_grid(Canvas& canvas, const PolarFrame& frame, const plot::Ticks& ticks) {
    for (const plot::Tick& tick : ticks.major) {
        draw_ring(canvas, frame.centre, kRadius * frame.scale.fraction_of(tick.value), {kGridColour, 0.8});
    }
    for (int theta_deg = -90; theta_deg <= 90; theta_deg += kSpokeStep_deg) {
        canvas.line(frame.centre, around(frame.centre, theta_deg, kRadius), {kGridColour, 0.8});
    }
}

void draw_outline(Canvas& canvas, const PolarFrame& frame) {
    draw_ring(canvas, frame.centre, kRadius, {plot::kInk, 0.8});
    canvas.line(around(frame.centre, -90, kRadius), around(frame.centre, 90, kRadius), {plot::kInk, 0.8});
    for (int theta_deg = -90; theta_deg <= 90; theta_deg += kLabelStep_deg) {
        const plot::HorizontalPart part = theta_deg < 0   ? plot::HorizontalPart::right
                                          : theta_deg > 0 ? plot::HorizontalPart::left
                                                          : plot::HorizontalPart::center;
        canvas.text(around(frame.centre, theta_deg, kRadius + (theta_deg == 0 ? kAngleGap : kAngleGap / 2)),
                    plot::number_text(theta_deg, 0) + "°",
                    {.size = plot::kAxisTextSize,
                     .colour = plot::kInk,
                     .horizontal = part,
                     .vertical = plot::VerticalPart::middle});
    }
}

void draw_series(Canvas& canvas, const std::vector<PlacedSeries>& all) {
    for (const PlacedSeries& placed : all) draw_areas(canvas, placed);
    for (const PlacedSeries& placed : all) draw_points(canvas, placed, [](const Point&) { return true; });
}

}  // namespace

void draw_polar_plot(const PolarPlot& drawn, const std::filesystem::path& path) {
    require_consistency(drawn.series);
    require_angles(drawn.series);
    const double top =
        kMargin + (drawn.title.empty() ? 0 : kPlotTitleSize + 14) + kAngleGap + plot::kAxisTextSize;
    const PolarFrame frame{scale_of(drawn.series), {kMargin + kAngleRoom + kRadius, top + kRadius}};
    const plot::Ticks ticks = nice_ticks(frame.scale, 6);
    std::vector<PlacedSeries> all;
    for (std::size_t i = 0; i < drawn.series.size(); ++i) {
        all.push_back(place_series(drawn.series[i], i, frame));
    }
    const double label = frame.centre.y + axis_extent(ticks, plot::Side::bottom) + 8 + kLabelSize;
    PageRectangle legend = legend_box(all);
    legend.left = frame.centre.x - legend.width / 2;
    legend.top = label + kLegendGap;

    Canvas canvas(path, frame.centre.x + kRadius + kAngleRoom + kMargin,
                  (legend.height > 0 ? legend.bottom() : label) + kMargin);
    canvas.text({frame.centre.x, kMargin + kPlotTitleSize}, drawn.title,
                {.size = kPlotTitleSize,
                 .colour = plot::kInk,
                 .weight = plot::Weight::bold,
                 .horizontal = plot::HorizontalPart::center});
    draw_grid(canvas, frame, ticks);
    draw_series(canvas, all);
    draw_outline(canvas, frame);
    draw_axis(canvas, frame.scale, ticks, plot::Side::bottom, frame.right_half());
    canvas.text({frame.centre.x, label}, drawn.value_label,
                {.size = kLabelSize, .colour = plot::kInk, .horizontal = plot::HorizontalPart::center});
    draw_legend(canvas, all, legend);
    canvas.save();
}

}  // namespace stilb::papers
