#include "files/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "files/axis_drawing.h"
#include "files/canvas.h"

namespace stilb {
namespace {

constexpr double kWidth = 620;  // of the frames
constexpr double kMargin = 20;
constexpr double kPanelGap = 16;
constexpr double kTitleSize = 15;
constexpr double kLabelSize = 11.5;
constexpr double kLegendSize = 10.5;
constexpr double kLegendLine = 18;
constexpr double kLegendPadding = 8;
constexpr double kSwatch = 28;
constexpr double kMarkerRadius = 3.2;
constexpr double kLineWidth = 1.7;
constexpr double kBandAlpha = 0.25;
/// Rounding of a point on the frame's edge.
constexpr double kEdgeSlack = 1e-6;
constexpr Colour kGridColour = grey(0.9);
/// Off-scale points are moved to at most this many frame heights away, which Cairo's fixed point numbers
/// hold.
constexpr double kFarthest = 8;

Scale make_scale(const PlotAxis& axis, const std::vector<double>& values) {
    const Range range = nice_range(axis.scale, values);
    return Scale(axis.scale, {axis.minimum.value_or(range.low), axis.maximum.value_or(range.high)});
}

Scale x_scale_of(const Plot& plot) {
    std::vector<double> values;
    for (const PlotPanel& panel : plot.panels) {
        for (const Series& series : panel.series) {
            values.insert(values.end(), series.x.begin(), series.x.end());
        }
    }
    return make_scale(plot.x, values);
}

Scale y_scale_of(const PlotPanel& panel) {
    std::vector<double> values;
    for (const Series& series : panel.series) {
        for (const auto* list : {&series.y, &series.y_low, &series.y_high}) {
            values.insert(values.end(), list->begin(), list->end());
        }
    }
    return make_scale(panel.y, values);
}

void require_consistency(const Plot& plot) {
    if (plot.panels.empty()) throw std::invalid_argument("a plot without panels");
    for (const PlotPanel& panel : plot.panels) {
        for (const Series& series : panel.series) {
            const std::size_t count = series.x.size();
            const bool has_interval = !series.y_low.empty() || !series.y_high.empty();
            if (series.y.size() != count ||
                (has_interval && (series.y_low.size() != count || series.y_high.size() != count))) {
                throw std::invalid_argument("series '" + series.name + "': lists of different lengths");
            }
        }
    }
}

/// One panel's ready-made scales and place.
struct Frame {
    Scale x, y;
    Ticks x_ticks, y_ticks;
    PageRectangle place;

    Frame(const Scale& x_scale, const Scale& y_scale, double height)
        : x(x_scale),
          y(y_scale),
          x_ticks(nice_ticks(x, static_cast<int>(kWidth / 60))),
          y_ticks(nice_ticks(y, std::max(4, static_cast<int>(height / 38)))),
          place{0, 0, kWidth, height} {}

    /// NaN where the value has no place at all.
    Point at(double x_value, double y_value) const {
        const double u = x.fraction_of(x_value);
        const double v = y.fraction_of(y_value);
        return {
            std::isfinite(u) ? place.left + std::clamp(u, -kFarthest, kFarthest) * place.width : NAN,
            std::isfinite(v) ? place.bottom() - std::clamp(v, -kFarthest, kFarthest) * place.height : NAN};
    }

    /// Whether the place lies within the frame's width.
    bool has_column(const Point& point) const {
        return point.x >= place.left - kEdgeSlack && point.x <= place.right() + kEdgeSlack;
    }

    /// Lower ends without a logarithm go down off the frame.
    double low_end(double y_value) const {
        return y.type() == ScaleType::logarithmic && y_value <= 0 ? y.value_at(-1) : y_value;
    }
};

bool has_place(const Point& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

/// Calls visit(points) for each stretch of points that all have a place.
template <typename Visit>
void for_each_stretch(const std::vector<Point>& points, Visit visit) {
    auto from = points.begin();
    while (from != points.end()) {
        from = std::find_if(from, points.end(), has_place);
        const auto to = std::find_if_not(from, points.end(), has_place);
        if (from != to) visit(std::span<const Point>(&*from, static_cast<std::size_t>(to - from)));
        from = to;
    }
}

std::vector<Point> places_of(const Series& series, const Frame& frame) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < series.x.size(); ++i) points.push_back(frame.at(series.x[i], series.y[i]));
    return points;
}

Colour colour_of(const PlotPanel& panel, std::size_t index) {
    return panel.series[index].colour.value_or(palette_colour(index));
}

Stroke line_stroke(LineStyle style, const Colour& colour) {
    return {colour, kLineWidth,
            style == LineStyle::dashed ? std::vector<double>{6, 4} : std::vector<double>{}};
}

void draw_marker(Canvas& canvas, MarkerStyle style, const Point& at, const Colour& colour) {
    // The white rim sets neighbours and the curve behind apart.
    const auto draw = [&](double radius, const Colour& fill) {
        if (style == MarkerStyle::circle) canvas.fill_circle(at, radius, fill);
        if (style == MarkerStyle::square) {
            const double side = 1.8 * radius;
            const PageRectangle square{at.x - side / 2, at.y - side / 2, side, side};
            const std::array<Point, 4> corners{{{square.left, square.top},
                                                {square.right(), square.top},
                                                {square.right(), square.bottom()},
                                                {square.left, square.bottom()}}};
            canvas.fill_polygon(corners, fill);
        }
    };
    draw(kMarkerRadius + 0.8, grey(1));
    draw(kMarkerRadius, colour);
}

void draw_bar(Canvas& canvas, const Point& low, const Point& high, const Colour& colour) {
    constexpr double kCap = 3;
    const Stroke stroke{colour, 1.1};
    canvas.line(low, high, stroke);
    for (const Point& end : {low, high}) canvas.line({end.x - kCap, end.y}, {end.x + kCap, end.y}, stroke);
}

/// The ends of the series' intervals; NaN where either has no place.
struct IntervalEnds {
    std::vector<Point> low, high;
};

IntervalEnds interval_ends(const Frame& frame, const Series& series) {
    IntervalEnds ends;
    for (std::size_t i = 0; i < series.y_low.size(); ++i) {
        ends.low.push_back(frame.at(series.x[i], frame.low_end(series.y_low[i])));
        ends.high.push_back(frame.at(series.x[i], series.y_high[i]));
        if (!has_place(ends.low[i]) || !has_place(ends.high[i])) ends.low[i] = ends.high[i] = {NAN, NAN};
    }
    return ends;
}

void draw_band(Canvas& canvas, const IntervalEnds& ends, const Colour& colour) {
    for_each_stretch(ends.low, [&](std::span<const Point> stretch) {
        const auto first = static_cast<std::size_t>(stretch.data() - ends.low.data());
        std::vector<Point> outline(stretch.begin(), stretch.end());
        for (std::size_t i = first + stretch.size(); i-- > first;) outline.push_back(ends.high[i]);
        canvas.fill_polygon(outline, with_alpha(colour, kBandAlpha));
    });
}

/// Bands and lines, which end at the frame.
void draw_areas(Canvas& canvas, const Frame& frame, const Series& series, const Colour& colour) {
    if (series.interval == IntervalStyle::band) draw_band(canvas, interval_ends(frame, series), colour);
    if (series.line == LineStyle::none) return;
    for_each_stretch(places_of(series, frame), [&](std::span<const Point> stretch) {
        canvas.polyline(stretch, line_stroke(series.line, colour));
    });
}

/// Bars and markers, which may reach over the frame's edge where their point lies on it.
void draw_points(Canvas& canvas, const Frame& frame, const Series& series, const Colour& colour) {
    if (series.interval == IntervalStyle::bars) {
        const IntervalEnds ends = interval_ends(frame, series);
        for (std::size_t i = 0; i < ends.low.size(); ++i) {
            if (frame.has_column(ends.low[i])) draw_bar(canvas, ends.low[i], ends.high[i], colour);
        }
    }
    if (series.marker == MarkerStyle::none) return;
    for (const Point& point : places_of(series, frame)) {
        if (frame.has_column(point)) draw_marker(canvas, series.marker, point, colour);
    }
}

void draw_grid_lines(Canvas& canvas, const Frame& frame) {
    const PageRectangle& place = frame.place;
    for (const Tick& tick : frame.x_ticks.major) {
        const double x = position_along(frame.x, Side::bottom, place, tick.value);
        canvas.line({x, place.top}, {x, place.bottom()}, {kGridColour, 0.8});
    }
    for (const Tick& tick : frame.y_ticks.major) {
        const double y = position_along(frame.y, Side::left, place, tick.value);
        canvas.line({place.left, y}, {place.right(), y}, {kGridColour, 0.8});
    }
}

std::vector<std::size_t> named_series(const PlotPanel& panel) {
    std::vector<std::size_t> named;
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        if (!panel.series[i].name.empty()) named.push_back(i);
    }
    return named;
}

/// How much of the panel's curves lies within `area`.
int crowd_within(const PageRectangle& area, const PlotPanel& panel, const Frame& frame) {
    constexpr int kPieces = 16;  // a long straight piece has few points of its own
    int crowd = 0;
    const auto count = [&](const Point& p) {
        crowd += p.x > area.left && p.x < area.right() && p.y > area.top && p.y < area.bottom() ? 1 : 0;
    };
    for (const Series& series : panel.series) {
        const std::vector<Point> points = places_of(series, frame);
        for (std::size_t i = 1; i < points.size() && series.line != LineStyle::none; ++i) {
            for (int k = 0; k < kPieces; ++k) {
                const double t = double(k) / kPieces;
                count({points[i - 1].x + t * (points[i].x - points[i - 1].x),
                       points[i - 1].y + t * (points[i].y - points[i - 1].y)});
            }
        }
        for (const Point& point : points) count(point);
        for (std::size_t i = 0; i < series.y_low.size(); ++i) {
            count(frame.at(series.x[i], frame.low_end(series.y_low[i])));
            count(frame.at(series.x[i], series.y_high[i]));
        }
    }
    return crowd;
}

/// The corner of the frame where the legend hides least.
PageRectangle place_legend(const PlotPanel& panel, const Frame& frame, double width, double height) {
    constexpr double kInset = 10;
    const PageRectangle& place = frame.place;
    PageRectangle best;
    int least = -1;
    for (const double top : {place.top + kInset, place.bottom() - kInset - height}) {
        for (const double left : {place.right() - kInset - width, place.left + kInset}) {
            const PageRectangle area{left, top, width, height};
            const int crowd = crowd_within(area, panel, frame);
            if (least >= 0 && crowd >= least) continue;
            least = crowd;
            best = area;
        }
    }
    return best;
}

void draw_swatch(Canvas& canvas, const Series& series, const Point& left, const Colour& colour) {
    const Point middle{left.x + kSwatch / 2, left.y};
    const bool has_interval = !series.y_low.empty();
    if (has_interval && series.interval == IntervalStyle::band) {
        canvas.fill_rectangle({left.x, left.y - 5, kSwatch, 10}, with_alpha(colour, kBandAlpha));
    }
    if (has_interval && series.interval == IntervalStyle::bars) {
        draw_bar(canvas, {middle.x, middle.y + 6.5}, {middle.x, middle.y - 6.5}, colour);
    }
    if (series.line != LineStyle::none) {
        canvas.line(left, {left.x + kSwatch, left.y}, line_stroke(series.line, colour));
    }
    draw_marker(canvas, series.marker, middle, colour);
}

void draw_legend(Canvas& canvas, const PlotPanel& panel, const Frame& frame) {
    const std::vector<std::size_t> named = named_series(panel);
    if (named.empty()) return;
    double widest = 0;
    for (const std::size_t i : named) {
        widest = std::max(widest, text_width(panel.series[i].name, kLegendSize));
    }
    const PageRectangle box = place_legend(panel, frame, 2 * kLegendPadding + kSwatch + 8 + widest,
                                           kLegendPadding + kLegendLine * double(named.size()));
    canvas.fill_rectangle(box, with_alpha(grey(1), 0.88));
    canvas.stroke_rectangle(box, {grey(0.8), 0.8});
    Point at{box.left + kLegendPadding, box.top + (kLegendPadding + kLegendLine) / 2};
    for (const std::size_t i : named) {
        draw_swatch(canvas, panel.series[i], at, colour_of(panel, i));
        canvas.text({at.x + kSwatch + 8, at.y}, panel.series[i].name,
                    {.size = kLegendSize, .colour = kInk, .vertical = VerticalPart::middle});
        at.y += kLegendLine;
    }
}

void draw_panel(Canvas& canvas, const PlotPanel& panel, const Frame& frame) {
    draw_grid_lines(canvas, frame);
    const auto draw_all = [&](const PageRectangle& within, auto draw) {
        canvas.clipped(within, [&] {
            for (std::size_t i = 0; i < panel.series.size(); ++i) {
                draw(canvas, frame, panel.series[i], colour_of(panel, i));
            }
        });
    };
    constexpr double kOver = kMarkerRadius + 1;
    const PageRectangle& place = frame.place;
    draw_all(place, draw_areas);
    canvas.stroke_rectangle(place, {kInk, 0.8});
    draw_all({place.left - kOver, place.top - kOver, place.width + 2 * kOver, place.height + 2 * kOver},
             draw_points);
    draw_legend(canvas, panel, frame);
    draw_axis(canvas, frame.x, frame.x_ticks, Side::bottom, place);
    draw_axis(canvas, frame.y, frame.y_ticks, Side::left, place);
    canvas.text(
        {kMargin + kLabelSize, place.center().y}, panel.y.label,
        {.size = kLabelSize, .colour = kInk, .horizontal = HorizontalPart::center, .angle_rad = kUpwards});
}

}  // namespace

Colour palette_colour(std::size_t index) {
    static constexpr std::array<std::array<int, 3>, 7> kPalette{{{0, 114, 178},
                                                                 {213, 94, 0},
                                                                 {0, 158, 115},
                                                                 {204, 121, 167},
                                                                 {230, 159, 0},
                                                                 {86, 180, 233},
                                                                 {0, 0, 0}}};
    const auto& [red, green, blue] = kPalette[index % kPalette.size()];
    return {red / 255.0, green / 255.0, blue / 255.0};
}

void draw_plot(const Plot& plot, const std::filesystem::path& path) {
    require_consistency(plot);
    const Scale x = x_scale_of(plot);
    std::vector<Frame> frames;
    double extent = 0;
    for (const PlotPanel& panel : plot.panels) {
        frames.emplace_back(x, y_scale_of(panel), panel.height);
        extent = std::max(extent, axis_extent(frames.back().y_ticks, Side::left));
    }
    double bottom = kMargin + (plot.title.empty() ? 0 : kTitleSize + 14);
    for (Frame& frame : frames) {
        frame.place.left = kMargin + kLabelSize + 12 + extent;
        frame.place.top = bottom;
        bottom = frame.place.bottom() + kPanelGap;
    }
    const PageRectangle& last = frames.back().place;
    const double x_label = last.bottom() + axis_extent(frames.back().x_ticks, Side::bottom) + 8 + kLabelSize;

    Canvas canvas(path, last.right() + kMargin + 8, x_label + kMargin);
    canvas.text({last.left, kMargin + kTitleSize}, plot.title,
                {.size = kTitleSize, .colour = kInk, .weight = Weight::bold});
    // Only the lowest panel's x axis carries numbers.
    for (Frame& frame : std::span(frames).first(frames.size() - 1)) {
        for (Tick& tick : frame.x_ticks.major) tick.label.clear();
    }
    for (std::size_t i = 0; i < frames.size(); ++i) draw_panel(canvas, plot.panels[i], frames[i]);
    canvas.text({last.center().x, x_label}, plot.x.label,
                {.size = kLabelSize, .colour = kInk, .horizontal = HorizontalPart::center});
    canvas.save();
}

}  // namespace stilb
