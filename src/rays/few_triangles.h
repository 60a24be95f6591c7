// Scattered packets against every triangle of a scene that has few: faster than Embree, whose traversal takes
// rays one by one where they part.
//
// A line passes through a triangle if it passes the three edges on one side, by its products with them in
// Pluecker coordinates [Shoemake 1998]. Products that may have the wrong sign by their rounding error are
// computed again in double precision. So rays meet each triangle exactly where it is: none passes between two
// of them, and none is caught beside an edge, as at a small opening.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/rays.h"
#include "base/vec.h"
#include "rays/surface_packet.h"

namespace stilb::rays {

/// Products of a line with the edges of a triangle that are opposite its second, third and first corner, in
/// double precision. An edge's product changes its sign with the order of the ends and is the same otherwise,
/// bit by bit: a line that passes between two triangles passes through one of them.
struct EdgeProducts {
    double u, v, w;
    bool are_inside() const { return std::min({u, v, w}) >= 0 || std::max({u, v, w}) <= 0; }
};
/// Precondition: the coordinates are numbers of single precision, so that their differences are exact.
EdgeProducts edge_products(const std::array<Vec3, 3>& corners, const Vec3& origin, const Vec3& direction);

/// A triangle as lines are tested against it, relative to RayCaster::center().
struct TestedTriangle {
    using Vector = std::array<float, 3>;
    struct Edge {
        Vector direction, moment;
    };
    std::array<Edge, 3> edges;  ///< opposite the second, the third and the first corner
    std::array<Vector, 3> corners;
    Vector normal;
    /// Bound of the products' rounding errors, for a ray of length 1 and for each metre of the sum of its
    /// origin's distance from the centre and FewTriangles' radius.
    float rounding_m = 0;
    std::uint32_t object = 0, primitive = 0;
};

/// Immutable once all triangles are added.
class FewTriangles {
  public:
    /// With so many, full packets take as long as with Embree.
    static constexpr std::size_t kMost = 96;

    /// `radius_m`: most triangles are not farther from the centre. Those that are have wider bounds of
    /// rounding errors than they need, and more products in double precision.
    explicit FewTriangles(double radius_m) : radius_m_(radius_m) {}

    /// With the indices that hits are to have.
    void add(std::uint32_t object, std::uint32_t primitive,
             const std::array<TestedTriangle::Vector, 3>& corners);
    /// Whether packets with these lanes are faster here than with Embree.
    bool are_faster(const LaneMask& lanes) const;

    /// As RayCaster does it; the normals of hits have the length 1, instances are not set.
    void closest(RayHitPacket& packet, const LaneMask& lanes) const;
    void occlude(RayPacket& packet, const LaneMask& lanes) const;

  private:
    double radius_m_;
    std::vector<TestedTriangle> triangles_;
};

}  // namespace stilb::rays
