#include "rays/grazed_edges.h"

#include <array>
#include <cmath>

#include "rays/few_triangles.h"

namespace stilb::rays {
namespace {

/// The search for a triangle around a hit that the ray meets.
struct Neighbours {
    const std::vector<std::unique_ptr<EmbreeGeometry>>& geometries;
    Vec3 origin, direction;
    bool is_met = false;
};

/// Whether the box around the corners is nearer to the point of the query than its radius.
bool is_near(const std::array<Vec3, 3>& corners, const RTCPointQuery& query) {
    Bounds box;
    for (const Vec3& corner : corners) box.include(corner);
    const double r = query.radius;
    return query.x >= box.min.x - r && query.x <= box.max.x + r && query.y >= box.min.y - r &&
           query.y <= box.max.y + r && query.z >= box.min.z - r && query.z <= box.max.z + r;
}

/// Sets `is_met` where the ray meets a triangle. Those of instances count as met: their rays are others.
/// Called for triangles beside those that are near, too.
bool look_at(RTCPointQueryFunctionArguments* arguments) {
    Neighbours& neighbours = *static_cast<Neighbours*>(arguments->userPtr);
    if (arguments->context->instStackSize > 0) {
        neighbours.is_met = true;
        return false;
    }
    const EmbreeGeometry& geometry = *neighbours.geometries[arguments->geomID];
    if (geometry.vertices != nullptr) {
        const std::array<Vec3, 3> corners = geometry.corners_of(arguments->primID);
        if (is_near(corners, *arguments->query) &&
            edge_products(corners, neighbours.origin, neighbours.direction).are_inside())
            neighbours.is_met = true;
    }
    return false;  // the radius stays
}

/// The least barycentric coordinate of all hits.
STILB_VECTORIZED float least_coordinate(const RayPacket::Words& __restrict object,
                                        const RayPacket::Floats& __restrict u,
                                        const RayPacket::Floats& __restrict v) {
    RayPacket::Floats least;
    for (int i = 0; i < kPacketWidth; ++i) {
        const float coordinate = std::min(std::min(u[i], v[i]), 1 - u[i] - v[i]);
        least[i] = object[i] == kNothing ? 1 : coordinate;
    }
    float all = 1;
    for (int i = 0; i < kPacketWidth; ++i) all = std::min(all, least[i]);
    return all;
}

}  // namespace

bool GrazedEdges::any_near_edge(const RayHitPacket& packet) {
    return least_coordinate(packet.object, packet.u, packet.v) < kNear;
}

void GrazedEdges::drop_from_occlusion(const RTCFilterFunctionNArguments* arguments) {
    const GrazedEdges& edges = *static_cast<const GrazedEdges*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const RTCRayHit found{rtcGetRayFromRayN(arguments->ray, arguments->N, i),
                              rtcGetHitFromHitN(arguments->hit, arguments->N, i)};
        if (edges.is_beside(found)) arguments->valid[i] = 0;
    }
}

bool GrazedEdges::meets_nothing(const RTCRayHit& found) const {
    const auto& [ray, hit] = found;
    if (hit.instID[0] != RTC_INVALID_GEOMETRY_ID) return false;
    const EmbreeGeometry& geometry = *geometries_[hit.geomID];
    if (geometry.vertices == nullptr) return false;
    Neighbours neighbours{geometries_, {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}};
    const std::array<Vec3, 3> corners = geometry.corners_of(hit.primID);
    if (edge_products(corners, neighbours.origin, neighbours.direction).are_inside()) return false;
    // The ray may meet another triangle with this edge or corner, although Embree has missed that one.
    const Vec3 at = neighbours.origin + double{ray.tfar} * neighbours.direction;
    double largest_m = length(at);
    for (const Vec3& corner : corners) largest_m = std::max(largest_m, length(corner - at));
    RTCPointQuery query{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z), 0,
                        static_cast<float>(kNear * largest_m)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, look_at, &neighbours);
    return !neighbours.is_met;
}

}  // namespace stilb::rays
