// A convex polygon as a surface element sees it: clipped at the horizon and projected onto the unit disk.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "base/vec.h"

namespace stilb::lights {

class SeenPolygon {
  public:
    static constexpr std::size_t kMostVertices = 4;

    /// `vertices`: up to kMostVertices, relative to the element, in a frame whose z axis is its normal;
    /// counterclockwise as seen from where z is large. Those below the horizon are clipped.
    explicit SeenPolygon(std::span<const Vec3> vertices);

    /// Lambert's formula; accurate to about 1e-16 over the polygon's angular size.
    double projected_solid_angle_sr() const { return projected_sr_; }
    /// A direction that is uniform by projected solid angle; nothing where that is 0 to rounding.
    std::optional<Vec3> sample(double u1, double u2) const;

  private:
    struct Edge {
        Vec3 normal;  ///< unit, of the plane through the edge and the element; 0 for an edge without size
        bool is_outer() const { return normal.z > 0; }
        bool is_inner() const { return normal.z < 0; }
    };
    struct Azimuth;
    class EllipseSector;
    struct Sector;
    struct Sectors;

    std::size_t next(std::size_t i) const { return i + 1 == count_ ? 0 : i + 1; }
    std::size_t previous(std::size_t i) const { return (i == 0 ? count_ : i) - 1; }
    Sectors sectors() const;

    std::array<Vec3, kMostVertices + 1> vertices_;
    std::array<Edge, kMostVertices + 1> edges_;  ///< from each vertex to the next
    std::size_t count_ = 0;
    bool has_inner_ = false;
    double projected_sr_ = 0;
};

}  // namespace stilb::lights
