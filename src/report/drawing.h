// Drawings in a report: SVG inside of the page, with texts in the page's own font. The page's style sheet
// gives colours and line widths, by class.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plot/axis.h"
#include "plot/canvas.h"
#include "report/html.h"

namespace stilb::report {

using plot::Point;

/// A length or coordinate with a hundredth of a pixel.
std::string pixels(double length);
/// "M0 0L10 5"; closed with a Z. Several paths of one class may be joined to one text.
enum class Ends { open, closed };
std::string path_of(std::span<const Point> points, Ends ends = Ends::open);
/// "#rrggbb".
std::string hexadecimal(const io::Colour& colour);

/// Lengths are in CSS pixels, 1/96 inch; y grows downwards.
class Drawing {
  public:
    /// `label`: the contents in words.
    Drawing(double width, double height, std::string label);

    void path(std::string_view css_class, const std::string& path);
    /// With a colour, or a width of its line, of its own.
    void filled_path(std::string_view css_class, const std::string& path, const io::Colour& fill);
    void stroked_path(std::string_view css_class, const std::string& path, double width);
    void line(std::string_view css_class, const Point& from, const Point& to);
    void circle(std::string_view css_class, const Point& center, double radius);
    enum class Anchor { start, middle, end };
    void text(std::string_view css_class, const Point& at, const std::string& text,
              Anchor anchor = Anchor::start, double angle_rad = 0);
    /// A number in its cell, of its own size and colour.
    void number(const Point& center, const std::string& text, double size, const io::Colour& colour);

    /// The contents of another drawing, at the same place, as far as they lie in a region. `id`: of the
    /// region, not used twice on a page.
    void clipped(const std::string& id, const std::string& region, const Drawing& contents);

    Html html() const;

  private:
    double width_, height_;
    std::string label_;
    Html shapes_;
};

// Drawings to scale.

/// A rectangle of a plane on a drawing, 1 : ratio where a pixel is 1/96 inch.
struct ScaledFrame {
    plot::AxisRange x_m, y_m;
    double ratio = 1;
    Point origin;  ///< the upper left corner on the drawing

    double pixels_per_m() const;
    plot::PageRectangle rectangle() const;
    Point at(double x_m, double y_m) const;
};

/// The smallest usual ratio from 1 on (10, 20, 25, 50 ...) at which the lengths are at most so many pixels.
double usual_ratio(double width_m, double height_m, double most_width, double most_height);

/// Above and to the right of a frame.
inline constexpr double kDrawingMargin = 10;
/// Space for the labels of axes to the left of a frame, and below it.
inline constexpr double kAxisLeft = 38, kAxisBelow = 22;
/// A thin frame with metres along its left and its lower side.
void draw_metres(Drawing& drawing, const ScaledFrame& frame);

}  // namespace stilb::report
