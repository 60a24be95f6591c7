#include "plot/polar_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include "plot/axis.h"
#include "plot/axis_drawing.h"
#include "plot/series_drawing.h"

namespace stilb::plot {
namespace {

constexpr double kRadius = 310;  // of the half disk
constexpr int kSpokeStep_deg = 15;
constexpr int kLabelStep_deg = 30;
/// Between the disk and the angles around it.
constexpr double kAngleGap = 14;
constexpr double kAngleRoom = 44;
constexpr double kLegendGap = 16;

Scale scale_of(const std::vector<Series>& all) {
    std::vector<double> values{0};
    for (const Series& series : all) {
        for (const auto* list : {&series.y, &series.y_low, &series.y_high}) {
            for (const double value : *list) values.push_back(std::max(value, 0.0));
        }
    }
    return Scale(ScaleType::linear, nice_range(ScaleType::linear, values));
}

void require_angles(const std::vector<Series>& all) {
    for (const Series& series : all) {
        for (const double theta_deg : series.x) {
            if (std::abs(theta_deg) <= 90) continue;
            throw std::invalid_argument(
                fmt::format("series '{}': theta = {}, not within 90 degrees", series.name, theta_deg));
        }
    }
}

Point around(const Point& centre, double theta_deg, double radius) {
    const double theta = theta_deg * std::numbers::pi / 180;
    return {centre.x + radius * std::sin(theta), centre.y - radius * std::cos(theta)};
}

struct PolarFrame {
    Scale scale;
    Point centre;

    Point at(double theta_deg, double value) const {
        if (!std::isfinite(value)) return {NAN, NAN};
        return around(centre, theta_deg, kRadius * std::max(0.0, scale.fraction_of(value)));
    }
    double low_end(double value) const { return value; }
    /// The right half's, which the scale runs below.
    PageRectangle right_half() const { return {centre.x, centre.y - kRadius, kRadius, kRadius}; }
};

void draw_ring(Canvas& canvas, const Point& centre, double radius, const Stroke& stroke) {
    std::vector<Point> arc;
    for (int theta_deg = -90; theta_deg <= 90; ++theta_deg) arc.push_back(around(centre, theta_deg, radius));
    canvas.polyline(arc, stroke);
}

void draw_grid(Canvas& canvas, const PolarFrame& frame, const Ticks& ticks) {
    for (const Tick& tick : ticks.major) {
        draw_ring(canvas, frame.centre, kRadius * frame.scale.fraction_of(tick.value), {kGridColour, 0.8});
    }
    for (int theta_deg = -90; theta_deg <= 90; theta_deg += kSpokeStep_deg) {
        canvas.line(frame.centre, around(frame.centre, theta_deg, kRadius), {kGridColour, 0.8});
    }
}

void draw_outline(Canvas& canvas, const PolarFrame& frame) {
    draw_ring(canvas, frame.centre, kRadius, {kInk, 0.8});
    canvas.line(around(frame.centre, -90, kRadius), around(frame.centre, 90, kRadius), {kInk, 0.8});
    for (int theta_deg = -90; theta_deg <= 90; theta_deg += kLabelStep_deg) {
        const HorizontalPart part = theta_deg < 0   ? HorizontalPart::right
                                    : theta_deg > 0 ? HorizontalPart::left
                                                    : HorizontalPart::center;
        canvas.text(
            around(frame.centre, theta_deg, kRadius + (theta_deg == 0 ? kAngleGap : kAngleGap / 2)),
            number_text(theta_deg, 0) + "°",
            {.size = kAxisTextSize, .colour = kInk, .horizontal = part, .vertical = VerticalPart::middle});
    }
}

void draw_series(Canvas& canvas, const std::vector<PlacedSeries>& all) {
    for (const PlacedSeries& placed : all) draw_areas(canvas, placed);
    for (const PlacedSeries& placed : all) draw_points(canvas, placed, [](const Point&) { return true; });
}

}  // namespace

void draw_polar_plot(const PolarPlot& plot, const std::filesystem::path& path) {
    require_consistency(plot.series);
    require_angles(plot.series);
    const double top = kMargin + (plot.title.empty() ? 0 : kTitleSize + 14) + kAngleGap + kAxisTextSize;
    const PolarFrame frame{scale_of(plot.series), {kMargin + kAngleRoom + kRadius, top + kRadius}};
    const Ticks ticks = nice_ticks(frame.scale, 6);
    std::vector<PlacedSeries> all;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        all.push_back(place_series(plot.series[i], i, frame));
    }
    const double label = frame.centre.y + axis_extent(ticks, Side::bottom) + 8 + kLabelSize;
    PageRectangle legend = legend_box(all);
    legend.left = frame.centre.x - legend.width / 2;
    legend.top = label + kLegendGap;

    Canvas canvas(path, frame.centre.x + kRadius + kAngleRoom + kMargin,
                  (legend.height > 0 ? legend.bottom() : label) + kMargin);
    canvas.text(
        {frame.centre.x, kMargin + kTitleSize}, plot.title,
        {.size = kTitleSize, .colour = kInk, .weight = Weight::bold, .horizontal = HorizontalPart::center});
    draw_grid(canvas, frame, ticks);
    draw_series(canvas, all);
    draw_outline(canvas, frame);
    draw_axis(canvas, frame.scale, ticks, Side::bottom, frame.right_half());
    canvas.text({frame.centre.x, label}, plot.value_label,
                {.size = kLabelSize, .colour = kInk, .horizontal = HorizontalPart::center});
    draw_legend(canvas, all, legend);
    canvas.save();
}

}  // namespace stilb::plot
