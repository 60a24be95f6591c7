// Regions of a plane that polygons bound, in coordinates of the plane [m].
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace stilb::sensors {

struct PlanePoint {
    double x = 0, y = 0;
};
/// The corners in order, without the first one again.
using Ring = std::vector<PlanePoint>;

/// Twice the area, above 0 where the corners run counterclockwise.
double doubled_area(const Ring& ring);
/// Whether the point is inside, or not further than `margin_m` from an edge.
bool contains(const Ring& ring, const PlanePoint& point, double margin_m);
/// The distance to the nearest edge.
double distance_to(const Ring& ring, const PlanePoint& point);

/// The outline first, then the holes.
using Region = std::vector<Ring>;

/// A defect of a region: the ring, and what is wrong with it.
struct RegionFault {
    std::size_t ring = 0;
    std::string message;
};
/// Fewer than three corners, no area, edges that cross or touch others, holes outside of the outline.
std::optional<RegionFault> fault_of(const Region& region);

}  // namespace stilb::sensors
