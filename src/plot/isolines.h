// Lines of equal value over a grid.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plot/canvas.h"

namespace stilb::plot {

/// Polylines on which the grid's value is `level`, by marching squares between cell centres. `values` are nu
/// x nv, u fastest; NaN leaves a hole. x counts cells along u (0 to nu), y along v (0 to nv); values of the
/// border cells reach to the grid's edge. Closed lines repeat their first point.
std::vector<std::vector<Point>> find_isolines(std::span<const double> values, int nu, int nv, double level);

// Positions of labels along lines.

struct LabelPlace {
    Point center;
    double angle_rad = 0;  ///< along the line, never upside down
};

/// Places labels of several lines within one frame so that they do not touch each other or the frame.
class LabelPlacer {
  public:
    explicit LabelPlacer(const PageRectangle& frame) : frame_(frame) {}

    /// The position on the straightest free stretch; nothing where the line is too short, too crooked or has
    /// no room. room.
    std::optional<LabelPlace> place(std::span<const Point> line, double label_width);
    /// Labels of lines keep clear of a text.
    void avoid(const PageRectangle& text);

  private:
    bool is_free(const Point& center, double radius) const;

    struct Disk {
        Point center;
        double radius;
    };
    PageRectangle frame_;
    std::vector<Disk> taken_;
};

}  // namespace stilb::plot
