#include "plot/axis_drawing.h"

#include <algorithm>

namespace stilb::plot {
namespace {

constexpr double kTickLength = 5;
constexpr double kMinorLength = 2.5;
constexpr double kGap = 4;
Stroke tick_stroke() { return {kInk, 0.8}; }

/// The point `distance` outside the frame.
Point outside(Side side, const PageRectangle& frame, double along, double distance) {
    if (side == Side::left) return {frame.left - distance, along};
    if (side == Side::right) return {frame.right() + distance, along};
    return {along, frame.bottom() + distance};
}

}  // namespace

double position_along(const Scale& scale, Side side, const PageRectangle& frame, double value) {
    const double fraction = scale.fraction_of(value);
    return side == Side::bottom ? frame.left + fraction * frame.width
                                : frame.bottom() - fraction * frame.height;
}

void draw_axis(Canvas& canvas, const Scale& scale, const Ticks& ticks, Side side,
               const PageRectangle& frame) {
    const auto mark = [&](double value, double length) {
        const double along = position_along(scale, side, frame, value);
        canvas.line(outside(side, frame, along, 0), outside(side, frame, along, length), tick_stroke());
        return along;
    };
    TextStyle style{.size = kAxisTextSize, .colour = kInk};
    style.horizontal = side == Side::left    ? HorizontalPart::right
                       : side == Side::right ? HorizontalPart::left
                                             : HorizontalPart::center;
    style.vertical = side == Side::bottom ? VerticalPart::top : VerticalPart::middle;
    for (const double value : ticks.minor) mark(value, kMinorLength);
    for (const Tick& tick : ticks.major) {
        const double along = mark(tick.value, kTickLength);
        canvas.text(outside(side, frame, along, kTickLength + kGap), tick.label, style);
    }
}

double axis_extent(const Ticks& ticks, Side side) {
    double labels = side == Side::bottom ? kAxisTextSize : 0;
    if (side != Side::bottom) {
        for (const Tick& tick : ticks.major) {
            labels = std::max(labels, text_width(tick.label, kAxisTextSize));
        }
    }
    return kTickLength + kGap + labels;
}

}  // namespace stilb::plot
