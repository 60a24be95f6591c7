// Scales, and round numbers to label them with.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "plot/canvas.h"

namespace stilb::plot {

enum class ScaleType { linear, logarithmic };

struct AxisRange {
    double low = 0, high = 1;
};

/// Maps values between `low` and `high` to 0 .. 1.
class Scale {
  public:
    /// Throws InputError where low < high does not hold, or for a logarithmic scale from 0 or below.
    Scale(ScaleType type, AxisRange range);

    ScaleType type() const { return type_; }
    AxisRange range() const { return range_; }

    /// Not limited to 0 .. 1; minus infinity where the value has no logarithm, NaN for NaN.
    double fraction_of(double value) const;
    double value_at(double fraction) const;

  private:
    ScaleType type_;
    AxisRange range_;
};

struct Tick {
    double value = 0;
    std::string label;
};

struct Ticks {
    std::vector<Tick> major;
    std::vector<double> minor;
};

/// At most `most` labelled ticks within the scale: steps of 1, 2 or 5 times a power of ten; on a logarithmic
/// scale these numbers themselves or powers of ten (and linear steps where it spans too little for them).
Ticks nice_ticks(const Scale& scale, int most);

/// A range with round ends that holds all finite values (on a logarithmic scale: the positive ones). 0 to 1,
/// or 1 to 10, where there are none.
AxisRange nice_range(ScaleType type, std::span<const double> values);

/// A number in readable form: a true minus sign, thousands separated from 10 000 on, `decimals` places.
std::string number_text(double value, int decimals);

/// Decimal places that give `value` at least three significant digits.
int three_digit_decimals(double value);

// Axes as drawn: ticks, their labels and the axis label. Shared by all figures.

inline constexpr double kAxisTextSize = 10;
inline constexpr io::Colour kInk = io::grey(0.15);
inline constexpr io::Colour kFaintInk = io::grey(0.4);

/// The side of the frame that the axis runs along.
enum class Side { left, right, bottom };

/// The range of values along that side: left and right axes grow upwards.
double position_along(const Scale& scale, Side side, const PageRectangle& frame, double value);

/// Draws ticks outwards from the frame, with labels.
void draw_axis(Canvas& canvas, const Scale& scale, const Ticks& ticks, Side side, const PageRectangle& frame);

/// The space of ticks and labels outside of the frame.
double axis_extent(const Ticks& ticks, Side side);

}  // namespace stilb::plot
