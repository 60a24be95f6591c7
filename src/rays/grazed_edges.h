// Hits that Embree finds beside triangles.
//
// Its robust mode widens each triangle by 2^-23 of its height above an edge, so that no ray gets lost between
// two of them. A small opening between large triangles would be too small by that. So hits near an edge are
// looked at again in double precision: they are dropped where the ray meets neither this triangle nor another
// at the same place.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "rays/embree_geometry.h"
#include "rays/surface_packet.h"

namespace stilb::rays {

/// Keeps references to the scene and to its geometries, by number.
class GrazedEdges {
  public:
    GrazedEdges(RTCScene scene, const std::vector<std::unique_ptr<EmbreeGeometry>>& geometries)
        : scene_(scene), geometries_(geometries) {}

    /// For a geometry whose user data is a GrazedEdges: occlusion by such hits does not count. It costs
    /// shadow rays a fifth of their time.
    static void drop_from_occlusion(const RTCFilterFunctionNArguments* arguments);

    /// Whether the ray has no triangle at its hit.
    bool is_beside(const RTCRayHit& found) const {
        return is_near_edge(found.hit.u, found.hit.v) && meets_nothing(found);
    }
    /// Whether a hit of the packet is near to an edge.
    static bool any_near_edge(const RayHitPacket& packet);

  private:
    /// Embree's rounding error and widening are less, in barycentric coordinates.
    static constexpr float kNear = 0x1p-20F;

    static bool is_near_edge(float u, float v) { return std::min(std::min(u, v), 1 - u - v) < kNear; }
    bool meets_nothing(const RTCRayHit& found) const;

    RTCScene scene_;
    const std::vector<std::unique_ptr<EmbreeGeometry>>& geometries_;
};

}  // namespace stilb::rays
