// Scattered packets against every triangle of a scene that has few: faster than Embree, whose traversal takes
// rays one by one where they part.
//
// A line passes through a triangle if it passes the three edges on one side, by its products with them in
// Pluecker coordinates [Shoemake 1998]. Triangles that share an edge have the same product with opposite
// signs, bit by bit: no ray passes between them. Edges are widened by the rounding error of the products, so
// that none passes where many of them meet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/rays.h"
#include "rays/surface_packet.h"

namespace stilb::rays {

/// A triangle as lines are tested against it, relative to RayCaster::center().
struct TestedTriangle {
    using Vector = std::array<float, 3>;
    struct Edge {
        Vector direction, moment;
    };
    std::array<Edge, 3> edges;  ///< opposite the second, the third and the first corner
    Vector corner, normal;
    float tolerance = 0;  ///< rounding error of products, by that of a line
    std::uint32_t object = 0, primitive = 0;
};

/// Immutable once all triangles are added.
class FewTriangles {
  public:
    /// With so many, full packets take as long as with Embree.
    static constexpr std::size_t kMost = 96;

    /// `half_extent_m`: as of RayCaster.
    explicit FewTriangles(double half_extent_m) : half_extent_m_(static_cast<float>(half_extent_m)) {}

    /// With the indices that hits are to have.
    void add(std::uint32_t object, std::uint32_t primitive,
             const std::array<TestedTriangle::Vector, 3>& corners);
    /// Whether packets with these lanes are faster here than with Embree.
    bool are_faster(const LaneMask& lanes) const;

    /// As RayCaster does it; the normals of hits have the length 1, instances are not set.
    void closest(RayHitPacket& packet, const LaneMask& lanes) const;
    void occlude(RayPacket& packet, const LaneMask& lanes) const;

  private:
    float half_extent_m_;
    std::vector<TestedTriangle> triangles_;
};

}  // namespace stilb::rays
