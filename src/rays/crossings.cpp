#include "rays/crossings.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "rays/few_triangles.h"

namespace stilb::rays {
namespace {

/// Rays through more places than this are cut off.
constexpr int kMostPlaces = 10'000;
/// Surfaces in one plane are met at distances that differ by rounding, in shares of the coordinates.
constexpr double kSamePlace = 0x1p-18;

std::uint32_t object_of(std::uint32_t geometry, std::uint32_t instance) {
    return instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance;
}

/// The triangles around a place that a ray crosses anywhere.
struct Search {
    std::span<const std::unique_ptr<EmbreeGeometry>> geometries;
    Vec3 origin, direction;
    std::vector<CrossedPrimitive> found;

    bool is_crossed(const std::array<Vec3, 3>& corners) const {
        if (!edge_products(corners, origin, direction).are_inside()) return false;
        const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        return dot(normal, corners[0] - origin) * dot(normal, direction) > 0;  // in front of the origin
    }

    void add(std::uint32_t object, std::uint32_t primitive) {
        const EmbreeGeometry& geometry = *geometries[object];
        if (!geometry.curved && is_crossed(geometry.corners_of(primitive)))
            found.push_back({object, primitive});
    }
};

bool add_near_by(RTCPointQueryFunctionArguments* arguments) {
    const RTCPointQueryContext& context = *arguments->context;
    const std::uint32_t instance =
        context.instStackSize > 0 ? context.instID[context.instStackSize - 1] : RTC_INVALID_GEOMETRY_ID;
    static_cast<Search*>(arguments->userPtr)->add(object_of(arguments->geomID, instance), arguments->primID);
    return false;  // the radius stays
}

}  // namespace

std::vector<CrossedPrimitive> crossed_primitives(RTCScene scene,
                                                 std::span<const std::unique_ptr<EmbreeGeometry>> geometries,
                                                 RTCRay ray) {
    const Vec3 origin{ray.org_x, ray.org_y, ray.org_z}, direction{ray.dir_x, ray.dir_y, ray.dir_z};
    Search search{geometries, origin, direction, {}};
    std::vector<CrossedPrimitive> curved;
    for (int i = 0; i < kMostPlaces; ++i) {
        RTCRayHit hit{ray, {}};
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene, &context, &hit);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
        const double distance_m = hit.ray.tfar;
        const CrossedPrimitive met{object_of(hit.hit.geomID, hit.hit.instID[0]), hit.hit.primID};
        (geometries[met.object]->curved ? curved : search.found).push_back(met);

        const Vec3 place = origin + distance_m * direction;
        const double radius_m = kSamePlace * std::max(largest_coordinate(place), distance_m);
        RTCPointQuery query{static_cast<float>(place.x), static_cast<float>(place.y),
                            static_cast<float>(place.z), 0, static_cast<float>(radius_m)};
        RTCPointQueryContext stack;
        rtcInitPointQueryContext(&stack);
        rtcPointQuery(scene, &query, &stack, add_near_by, &search);
        ray.tnear = static_cast<float>(distance_m + radius_m / 2);
    }
    std::vector<CrossedPrimitive>& all = search.found;
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    all.insert(all.end(), curved.begin(), curved.end());
    return all;
}

}  // namespace stilb::rays
