#include "papers/series_drawing.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "plot/axis.h"

namespace stilb::papers {
namespace {

constexpr double kLegendSize = 10.5;
constexpr double kLegendLine = 18;
constexpr double kLegendPadding = 8;
constexpr double kSwatch = 28;
constexpr double kSwatchGap = 8;
constexpr double kMarkerRadius = 3.2;
constexpr double kLineWidth = 1.7;
constexpr double kBandAlpha = 0.25;

/// Calls visit(points) for each stretch of points that all have a position.
template <typename Visit>
void for_each_stretch(const std::vector<Point>& points, Visit visit) {
    auto from = points.begin();
    while (from != points.end()) {
        from = std::find_if(from, points.end(), has_position);
        const auto to = std::find_if_not(from, points.end(), has_position);
        if (from != to) visit(std::span<const Point>(&*from, static_cast<std::size_t>(to - from)));
        from = to;
    }
}

Stroke line_stroke(LineStyle style, const io::Colour& colour) {
    return {colour, kLineWidth,
            style == LineStyle::dashed ? std::vector<double>{6, 4} : std::vector<double>{}};
}

void draw_marker(Canvas& canvas, MarkerStyle style, const Point& at, const io::Colour& colour) {
    // The white rim separates neighbours and the curve behind.
    const auto draw = [&](double radius, const io::Colour& fill) {
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
    draw(kMarkerReach, io::grey(1));
    draw(kMarkerRadius, colour);
}

/// An interval with caps at its ends, in any orientation.
void draw_bar(Canvas& canvas, const Point& low, const Point& high, const io::Colour& colour) {
    constexpr double kCap = 3;
    const Stroke stroke{colour, 1.1};
    const double length = std::hypot(high.x - low.x, high.y - low.y);
    const Point across = length > 0
                             ? Point{kCap * (low.y - high.y) / length, kCap * (high.x - low.x) / length}
                             : Point{kCap, 0};
    canvas.line(low, high, stroke);
    for (const Point& end : {low, high}) {
        canvas.line({end.x - across.x, end.y - across.y}, {end.x + across.x, end.y + across.y}, stroke);
    }
}

void draw_band(Canvas& canvas, const PlacedSeries& placed) {
    for_each_stretch(placed.low, [&](std::span<const Point> stretch) {
        const auto first = static_cast<std::size_t>(stretch.data() - placed.low.data());
        std::vector<Point> outline(stretch.begin(), stretch.end());
        for (std::size_t i = first + stretch.size(); i-- > first;) outline.push_back(placed.high[i]);
        canvas.fill_polygon(outline, with_alpha(placed.colour, kBandAlpha));
    });
}

void draw_swatch(Canvas& canvas, const PlacedSeries& placed, const Point& left) {
    const Series& series = placed.series;
    const Point middle{left.x + kSwatch / 2, left.y};
    const bool has_interval = !series.y_low.empty();
    if (has_interval && series.interval == IntervalStyle::band) {
        canvas.fill_rectangle({left.x, left.y - 5, kSwatch, 10}, with_alpha(placed.colour, kBandAlpha));
    }
    if (has_interval && series.interval == IntervalStyle::bars) {
        draw_bar(canvas, {middle.x, middle.y + 6.5}, {middle.x, middle.y - 6.5}, placed.colour);
    }
    if (series.line != LineStyle::none) {
        canvas.line(left, {left.x + kSwatch, left.y}, line_stroke(series.line, placed.colour));
    }
    draw_marker(canvas, series.marker, middle, placed.colour);
}

}  // namespace

bool has_position(const Point& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

void require_consistency(std::span<const Series> all) {
    for (const Series& series : all) {
        const std::size_t count = series.x.size();
        const bool has_interval = !series.y_low.empty() || !series.y_high.empty();
        if (series.y.size() != count ||
            (has_interval && (series.y_low.size() != count || series.y_high.size() != count))) {
            throw std::invalid_argument("series '" + series.name + "': lists of different lengths");
        }
    }
}

void draw_areas(Canvas& canvas, const PlacedSeries& placed) {
    if (placed.series.interval == IntervalStyle::band) draw_band(canvas, placed);
    if (placed.series.line == LineStyle::none) return;
    for_each_stretch(placed.points, [&](std::span<const Point> stretch) {
        canvas.polyline(stretch, line_stroke(placed.series.line, placed.colour));
    });
}

void draw_points(Canvas& canvas, const PlacedSeries& placed,
                 const std::function<bool(const Point&)>& is_within) {
    if (placed.series.interval == IntervalStyle::bars) {
        for (std::size_t i = 0; i < placed.low.size(); ++i) {
            if (!has_position(placed.low[i]) || !is_within(placed.low[i])) continue;
            draw_bar(canvas, placed.low[i], placed.high[i], placed.colour);
        }
    }
    if (placed.series.marker == MarkerStyle::none) return;
    for (const Point& point : placed.points) {
        if (!has_position(point) || !is_within(point)) continue;
        draw_marker(canvas, placed.series.marker, point, placed.colour);
    }
}

int crowd_within(const PageRectangle& area, std::span<const PlacedSeries> all) {
    constexpr int kPieces = 16;  // a long straight piece has few points of its own
    int crowd = 0;
    const auto count = [&](const Point& p) {
        crowd += p.x > area.left && p.x < area.right() && p.y > area.top && p.y < area.bottom() ? 1 : 0;
    };
    for (const PlacedSeries& placed : all) {
        const std::vector<Point>& points = placed.points;
        for (std::size_t i = 1; i < points.size() && placed.series.line != LineStyle::none; ++i) {
            for (int k = 0; k < kPieces; ++k) {
                const double t = double(k) / kPieces;
                count({points[i - 1].x + t * (points[i].x - points[i - 1].x),
                       points[i - 1].y + t * (points[i].y - points[i - 1].y)});
            }
        }
        for (const auto* list : {&points, &placed.low, &placed.high}) {
            for (const Point& point : *list) count(point);
        }
    }
    return crowd;
}

PageRectangle legend_box(std::span<const PlacedSeries> all) {
    double widest = 0;
    int named = 0;
    for (const PlacedSeries& placed : all) {
        if (placed.series.name.empty()) continue;
        ++named;
        widest = std::max(widest, plot::text_width(placed.series.name, kLegendSize));
    }
    if (named == 0) return {};
    return {0, 0, 2 * kLegendPadding + kSwatch + kSwatchGap + widest, kLegendPadding + kLegendLine * named};
}

void draw_legend(Canvas& canvas, std::span<const PlacedSeries> all, const PageRectangle& box) {
    if (box.height == 0) return;
    canvas.fill_rectangle(box, io::with_alpha(io::grey(1), 0.88));
    canvas.stroke_rectangle(box, {io::grey(0.8), 0.8});
    Point at{box.left + kLegendPadding, box.top + (kLegendPadding + kLegendLine) / 2};
    for (const PlacedSeries& placed : all) {
        if (placed.series.name.empty()) continue;
        draw_swatch(canvas, placed, at);
        canvas.text({at.x + kSwatch + kSwatchGap, at.y}, placed.series.name,
                    {.size = kLegendSize, .colour = plot::kInk, .vertical = plot::VerticalPart::middle});
        at.y += kLegendLine;
    }
}

io::Colour palette_colour(std::size_t index) {
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

}  // namespace stilb::papers
