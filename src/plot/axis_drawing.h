// Axes as drawn: ticks, their labels and what the axis is called. Shared by all figures.
#pragma once

#include <string>

#include "plot/axis.h"
#include "plot/canvas.h"

namespace stilb::plot {

inline constexpr double kAxisTextSize = 10;
inline constexpr io::Colour kInk = io::grey(0.15);
inline constexpr io::Colour kFaintInk = io::grey(0.4);

/// The side of the frame that the axis runs along.
enum class Side { left, right, bottom };

/// Where values lie along that side: left and right axes grow upwards.
double position_along(const Scale& scale, Side side, const PageRectangle& frame, double value);

/// Draws ticks outwards from the frame, with labels.
void draw_axis(Canvas& canvas, const Scale& scale, const Ticks& ticks, Side side, const PageRectangle& frame);

/// Room that ticks and labels take beyond the frame, away from it.
double axis_extent(const Ticks& ticks, Side side);

}  // namespace stilb::plot
