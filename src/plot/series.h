// Series: what plots show, as curves, measured points and intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/image/colour.h"

namespace stilb::plot {

enum class LineStyle { none, solid, dashed };
enum class MarkerStyle { none, circle, square };
enum class IntervalStyle { band, bars };

/// y over x. A NaN (or, on a logarithmic axis, what is not above 0) interrupts the line.
struct Series {
    std::string name;  ///< in the legend; empty: not in it
    std::vector<double> x, y;
    /// The interval of each y; both empty where there is none.
    std::vector<double> y_low{}, y_high{};
    LineStyle line = LineStyle::solid;
    MarkerStyle marker = MarkerStyle::none;
    IntervalStyle interval = IntervalStyle::band;
    /// Otherwise the palette's next, by position in the plot or panel.
    std::optional<io::Colour> colour{};
};

/// The palette's colours, told apart by colour-blind readers too [Okabe and Ito 2008]; repeats after seven.
io::Colour palette_colour(std::size_t index);

}  // namespace stilb::plot
