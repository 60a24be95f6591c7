// Drawing of series, and the common parts of all plots: title, label and legend.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "papers/plot.h"
#include "plot/canvas.h"

namespace stilb::papers {

using plot::Canvas, plot::PageRectangle, plot::Point, plot::Stroke;

inline constexpr double kMargin = 20;  // of the sheet
inline constexpr double kPlotTitleSize = 15;
inline constexpr double kLabelSize = 11.5;
inline constexpr io::Colour kGridColour = io::grey(0.9);
/// The extent of markers beyond their point.
inline constexpr double kMarkerReach = 4;

/// Throws std::invalid_argument where lists of a series differ in length.
void require_consistency(std::span<const Series> series);

/// A series with positions on the sheet, NaN for points without one.
struct PlacedSeries {
    const Series& series;
    io::Colour colour;
    std::vector<Point> points;
    std::vector<Point> low, high;  ///< ends of the intervals; both NaN where either has no position
};

/// `index`: its index among the others, for its colour. A frame has at(x, y) and low_end(y), where the
/// lower end of an interval is drawn.
template <typename Frame>
PlacedSeries place_series(const Series& series, std::size_t index, const Frame& frame);

/// Bands and lines, clipped at the frame.
void draw_areas(Canvas& canvas, const PlacedSeries& placed);
/// Bars and markers, which may extend over the frame's edge where their point lies on it.
void draw_points(Canvas& canvas, const PlacedSeries& placed,
                 const std::function<bool(const Point&)>& is_within);

/// The share of the curves within `area`.
int crowd_within(const PageRectangle& area, std::span<const PlacedSeries> all);

/// Its size, at the origin; empty where no series has a name.
PageRectangle legend_box(std::span<const PlacedSeries> all);
void draw_legend(Canvas& canvas, std::span<const PlacedSeries> all, const PageRectangle& box);

bool has_position(const Point& point);

template <typename Frame>
PlacedSeries place_series(const Series& series, std::size_t index, const Frame& frame) {
    PlacedSeries placed{series, series.colour.value_or(palette_colour(index)), {}, {}, {}};
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        placed.points.push_back(frame.at(series.x[i], series.y[i]));
    }
    for (std::size_t i = 0; i < series.y_low.size(); ++i) {
        Point low = frame.at(series.x[i], frame.low_end(series.y_low[i]));
        Point high = frame.at(series.x[i], series.y_high[i]);
        if (!has_position(low) || !has_position(high)) low = high = {NAN, NAN};
        placed.low.push_back(low);
        placed.high.push_back(high);
    }
    return placed;
}

}  // namespace stilb::papers
