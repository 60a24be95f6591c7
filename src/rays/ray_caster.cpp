#include "rays/ray_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "rays/acceleration_structure.h"
#include "rays/crossings.h"
#include "rays/few_triangles.h"
#include "rays/packet_parts.h"
#include "rays/surface_packet.h"
#include "scene/fine_things.h"
#include "scene/sealed_sides.h"

namespace stilb::rays {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

thread_local std::uint64_t traced_by_this_thread = 0;

void count(const LaneMask& lanes) {
    std::int32_t sum = 0;
    for (const std::int32_t lane : lanes) sum += lane;
    traced_by_this_thread += static_cast<std::uint64_t>(-sum);
}

/// The point with barycentric coordinates b, moved away from the triangle's edges by `margin` metres where it
/// is large enough for that; otherwise towards its middle.
struct InnerPoint {
    std::array<double, 3> b;
    bool was_at_edge = false;
};
InnerPoint away_from_edges(const std::array<double, 3>& b, const std::array<Vec3, 3>& v, double margin,
                           double size, double doubled_area) {
    // Most points are: no edge is longer than 2 sqrt(3) times the longest coordinate difference.
    if (std::min({b[0], b[1], b[2]}) * doubled_area >= margin * 4 * size) return {b};
    constexpr double most = 0.75;
    std::array<double, 3> least{};
    double least_sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double opposite_edge = length(v[(i + 2) % 3] - v[(i + 1) % 3]);
        least[i] = margin * opposite_edge / doubled_area;  // margin / height above that edge
        least_sum += least[i];
    }
    if (b[0] >= least[0] && b[1] >= least[1] && b[2] >= least[2]) return {b};
    if (least_sum > most) {
        for (double& l : least) l *= most / least_sum;
        least_sum = most;
    }
    std::array<double, 3> beyond{};
    for (std::size_t i = 0; i < 3; ++i) beyond[i] = std::max(b[i] - least[i], 0.0);
    const double beyond_sum = beyond[0] + beyond[1] + beyond[2];
    InnerPoint moved{{}, true};
    for (std::size_t i = 0; i < 3; ++i) {
        moved.b[i] = least[i] + (beyond_sum > 0 ? beyond[i] / beyond_sum : 1.0 / 3) * (1 - least_sum);
    }
    return moved;
}

}  // namespace

struct RayCaster::Implementation {
    const Scene& scene;
    std::vector<Vec3> measured;
    bool sees_fine_things;
    Lift lift_rule;
    const Vec3& center = lift_rule.center();  ///< the origin of Embree's coordinates
    bool has_panes = false, has_backs = false;
    std::shared_ptr<const AccelerationStructure> structure;
    const RTCScene embree_scene;
    const SharedMeshes& shared_meshes;
    const std::vector<std::unique_ptr<EmbreeGeometry>>& geometries;  ///< by object
    const GrazedEdges& grazed_edges;
    std::optional<FewTriangles> few_triangles;  ///< all of the scene, if it has few and nothing curved
    mutable std::once_flag sealed_once;         ///< is_sealed is found when it is asked for
    mutable std::vector<bool> is_sealed;        ///< sealed_sides()

    /// `known`: a structure of the same objects, which is taken where it suits the points; or null.
    Implementation(const Scene& s, const Monitor& monitor, std::span<const Vec3> points,
                   const std::shared_ptr<const AccelerationStructure>& known)
        : scene(s),
          measured(points.begin(), points.end()),
          sees_fine_things(scene::sees_fine_things(s, measured)),
          lift_rule(scene::lift_of(s, measured, sees_fine_things)),
          structure(structure_for({center, sees_fine_things}, monitor, known)),
          embree_scene(structure->scene),
          shared_meshes(structure->shared_meshes),
          geometries(structure->geometries),
          grazed_edges(*structure->grazed_edges) {
        has_panes = std::ranges::any_of(scene.objects, [&](const Object& object) {
            return std::ranges::any_of(object.materials,
                                       [&](MaterialId id) { return passes_straight(scene.material(id)); });
        });
        has_backs = scene::have_backs(scene);
        add_few_triangles();
    }

    std::shared_ptr<const AccelerationStructure> structure_for(
        const AccelerationStructure::Precision& precision, const Monitor& monitor,
        const std::shared_ptr<const AccelerationStructure>& known) const {
        require_within_reach(scene);
        if (known && known->precision == precision) return known;
        return std::make_shared<const AccelerationStructure>(scene, precision, monitor);
    }

    void add_few_triangles() {
        std::size_t count = 0;
        for (const auto& geometry : geometries) {
            if (geometry->curved || geometry->instance != nullptr) return;
            count += geometry->triangle_count;
        }
        if (count > FewTriangles::kMost) return;
        few_triangles.emplace(lift_rule.largest_size_m());
        for (std::uint32_t object = 0; object < geometries.size(); ++object) {
            const EmbreeGeometry& geometry = *geometries[object];
            for (std::uint32_t i = 0; i < geometry.triangle_count; ++i) {
                const auto& [a, b, c] = geometry.triangles[i];
                few_triangles->add(object, i,
                                   {geometry.vertices[a], geometry.vertices[b], geometry.vertices[c]});
            }
        }
    }

    bool takes_few_triangles(const LaneMask& lanes, Coherence coherence) const {
        return few_triangles && coherence == Coherence::scattered && few_triangles->are_faster(lanes);
    }

    Hit hit_of(const RTCRayHit& found) const {
        const auto& [ray, met] = found;
        const Vec3 origin{ray.org_x, ray.org_y, ray.org_z}, direction{ray.dir_x, ray.dir_y, ray.dir_z};
        double u = met.u, v = met.v;
        const std::uint32_t object = object_of(met.geomID, met.instID[0]);
        const EmbreeGeometry& geometry = *geometries[object];
        Hit hit;
        double size = 0;
        bool at_edge = false;
        Vec3 inner_position;  // away from edges: the base of lifted points
        if (geometry.vertices != nullptr) {
            const std::array<Vec3, 3> p = geometry.corners_of(met.primID);
            if (geometry.is_mirrored) std::swap(u, v);
            for (std::size_t i = 1; i < 3; ++i) {
                size = std::max(
                    {size, std::abs(p[i].x - p[0].x), std::abs(p[i].y - p[0].y), std::abs(p[i].z - p[0].z)});
            }
            const Vec3 edge_1 = p[1] - p[0], edge_2 = p[2] - p[0];
            const Vec3 doubled = cross(edge_1, edge_2);
            const double doubled_area = length(doubled);
            hit.normal = (1 / doubled_area) * doubled;
            hit.position = inner_position = p[0] + u * edge_1 + v * edge_2;
            const double margin = kEdgeMargin * offset(hit.position, size);
            const auto inner = away_from_edges({1 - u - v, u, v}, p, margin, size, doubled_area);
            if (inner.was_at_edge) {
                at_edge = true;
                inner_position = inner.b[0] * p[0] + inner.b[1] * p[1] + inner.b[2] * p[2];
            }
        } else {
            const Vec3 near_by = origin + ray.tfar * direction;
            const NearestPoint point = geometry.curved->nearest_point(met.primID, near_by);
            hit.position = inner_position = point.position;
            hit.normal = point.normal;
            size = point.size_m;
        }
        hit.on_front = dot(hit.normal, direction) < 0;
        if (!hit.on_front) hit.normal = -hit.normal;
        hit.lift_m = offset(inner_position, size);
        const Vec3 lift = hit.lift_m * hit.normal;
        hit.lifted = inner_position + lift;
        // At an edge where the mesh folds towards the ray, rounding may have selected the face behind the
        // fold, whose side towards the ray is outside. Then the other side faces the ray's origin or, where
        // the fold is sharp, neither: the last stretch of the ray itself decides.
        if (at_edge && occluded(origin, hit.lifted)) {
            if (!occluded(origin, inner_position - lift)) {
                hit.lifted = inner_position - lift;
                hit.normal = -hit.normal;
                hit.on_front = !hit.on_front;
            } else {
                const double back = kEdgeMargin * length(lift) / length(direction);
                hit.lifted = origin + std::max(ray.tfar - back, 0.0) * direction;
            }
        }
        hit.triangle = geometry.curved ? 0 : geometry.triangle_of(met.primID);
        hit.material = scene.on_side(material_of(object, hit.triangle), hit.on_front);
        hit.lifted += center;
        hit.position += center;
        hit.shading_normal = shading_normal_of(hit, geometry, {1.0 - met.u - met.v, met.u, met.v});
        hit.distance_m = ray.tfar;
        hit.object = ObjectId{object};
        return hit;
    }

    /// `barycentric`: in the triangle that Embree has met.
    static Vec3 shading_normal_of(const Hit& hit, const EmbreeGeometry& geometry, const Vec3& barycentric) {
        if (geometry.smooth == nullptr) return hit.normal;
        if (geometry.instance != nullptr)
            return shading_normal(*geometry.instance, hit.triangle, barycentric, hit.normal);
        const Vec3 in_parent = geometry.parents.empty()
                                   ? barycentric
                                   : geometry::barycentric_of(*geometry.smooth, hit.triangle, hit.position);
        return shading_normal(*geometry.smooth, hit.triangle, in_parent, hit.normal);
    }

    // Packets of Embree 3.13 do not always end where there are instances: their rays are traced one by one.

    bool takes_single_rays() const { return !shared_meshes.empty(); }

    static RTCRay ray_of(const RayPacket& packet, std::size_t lane) {
        RTCRay ray{};
        ray.org_x = packet.origin_x[lane], ray.org_y = packet.origin_y[lane];
        ray.org_z = packet.origin_z[lane], ray.tnear = packet.start[lane];
        ray.dir_x = packet.direction_x[lane], ray.dir_y = packet.direction_y[lane];
        ray.dir_z = packet.direction_z[lane], ray.tfar = packet.end[lane];
        ray.mask = packet.mask[lane];
        return ray;
    }

    void closest_by_single_rays(RayHitPacket& packet, const LaneMask& lanes) const {
        packet.object.fill(kNothing);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (lanes[i] != 0) find_closest(packet, i);
        }
    }

    /// The first hit of one ray of a packet that has none.
    void find_closest(RayHitPacket& packet, std::size_t lane) const {
        const RTCRayHit found = closest(ray_of(packet.ray, lane));
        const RTCHit& met = found.hit;
        if (met.geomID == RTC_INVALID_GEOMETRY_ID) return;
        packet.ray.end[lane] = found.ray.tfar;
        packet.normal_x[lane] = met.Ng_x, packet.normal_y[lane] = met.Ng_y, packet.normal_z[lane] = met.Ng_z;
        packet.u[lane] = met.u, packet.v[lane] = met.v;
        packet.primitive[lane] = met.primID;
        packet.object[lane] = object_of(met.geomID, met.instID[0]);
        packet.instance[lane] = met.instID[0];
    }

    RTCRayHit closest(RTCRay ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (;;) {
            RTCRayHit found{ray, {}};
            found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(embree_scene, &context, &found);
            if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID || !grazed_edges.is_beside(found)) return found;
            ray.tnear = std::nextafter(found.ray.tfar, kInfinity);
        }
    }

    /// Lets rays go on that have met an edge from beside. `ends`: of the rays before they have met something.
    void pass_edges(RayHitPacket& packet, const RayPacket::Floats& ends) const {
        if (!GrazedEdges::any_near_edge(packet)) return;
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (packet.object[i] == kNothing || !grazed_edges.is_beside(met_by(packet, i))) continue;
            const float start = packet.ray.start[i];
            packet.ray.start[i] = std::nextafter(packet.ray.end[i], kInfinity);
            packet.ray.end[i] = ends[i];
            packet.object[i] = kNothing;
            find_closest(packet, i);
            packet.ray.start[i] = start;
        }
    }

    void occlude_by_single_rays(RayPacket& packet, const LaneMask& lanes) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (lanes[i] == 0) continue;
            RTCRay ray = ray_of(packet, i);
            rtcOccluded1(embree_scene, &context, &ray);
            packet.end[i] = ray.tfar;
        }
    }

    /// A geometry of the scene itself is an object; within an instance, the instance is.
    std::uint32_t object_of(std::uint32_t geometry, std::uint32_t instance) const {
        return shared_meshes.empty() || instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance;
    }

    MaterialId material_of(std::uint32_t object, std::uint32_t triangle) const {
        const auto& materials = scene.objects[object].materials;
        return materials.size() == 1 ? materials[0] : materials[triangle];
    }

    /// As RayCaster::offset_m, for a position relative to the centre.
    double offset(const Vec3& relative, double size_m) const {
        return lift_rule.relative_offset_m(relative, size_m);
    }

    /// Origin relative to the centre.
    static RTCRay ray_from(const Vec3& origin, const Vec3& direction, float length) {
        RTCRay ray{};
        ray.org_x = static_cast<float>(origin.x), ray.org_y = static_cast<float>(origin.y);
        ray.org_z = static_cast<float>(origin.z);
        ray.dir_x = static_cast<float>(direction.x), ray.dir_y = static_cast<float>(direction.y);
        ray.dir_z = static_cast<float>(direction.z);
        ray.tfar = length;
        ray.mask = ~0u;
        return ray;
    }

    static RTCRayHit met_by(const RayHitPacket& packet, std::size_t lane) {
        auto* const found = reinterpret_cast<RTCRayHitN*>(const_cast<RayHitPacket*>(&packet));
        return rtcGetRayHitFromRayHitN(found, kPacketWidth, static_cast<unsigned>(lane));
    }

    /// Between positions relative to the centre.
    bool occluded(const Vec3& from, const Vec3& to) const {
        RTCRay ray = ray_from(from, to - from, 1);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(embree_scene, &context, &ray);
        return ray.tfar < 0;
    }
};

RayCaster::RayCaster(const Scene& scene, const Monitor& monitor, std::span<const Vec3> measured)
    : implementation_(std::make_unique<Implementation>(scene, monitor, measured, nullptr)) {}
RayCaster::RayCaster(const RayCaster& similar, const Scene& scene, const Monitor& monitor,
                     std::span<const Vec3> measured)
    : implementation_(
          std::make_unique<Implementation>(scene, monitor, measured, similar.implementation_->structure)) {}
RayCaster::~RayCaster() = default;

const Vec3& RayCaster::center() const { return implementation_->center; }
Lift RayCaster::lift() const { return implementation_->lift_rule; }
double RayCaster::half_extent_m() const { return implementation_->lift_rule.half_extent_m(); }
double RayCaster::offset_m(const Vec3& position, double size_m) const {
    return implementation_->offset(position - center(), size_m);
}

std::optional<Hit> RayCaster::closest(const Vec3& origin, const Vec3& direction) const {
    ++traced_by_this_thread;
    const RTCRayHit found =
        implementation_->closest(Implementation::ray_from(origin - center(), direction, kInfinity));
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return implementation_->hit_of(found);
}

std::vector<Crossing> RayCaster::crossings(const Vec3& origin, const Vec3& direction) const {
    const Implementation& own = *implementation_;
    std::vector<Crossing> crossings;
    for (const auto& [object, primitive] :
         crossed_primitives(own.embree_scene, own.geometries,
                            Implementation::ray_from(origin - center(), direction, kInfinity))) {
        const EmbreeGeometry& geometry = *own.geometries[object];
        const std::uint32_t triangle = geometry.curved ? 0 : geometry.triangle_of(primitive);
        crossings.push_back({ObjectId{object}, own.material_of(object, triangle), triangle});
    }
    return crossings;
}

void RayCaster::closest(std::span<const Ray> rays, Coherence coherence,
                        std::span<std::optional<Hit>> hits) const {
    RayHitPacket packet;
    for (std::size_t first = 0; first < rays.size(); first += kPacketWidth) {
        const std::size_t count = std::min<std::size_t>(kPacketWidth, rays.size() - first);
        LaneMask lanes{};
        for (std::size_t i = 0; i < count; ++i) {
            const auto& [origin, direction] = rays[first + i];
            packet.ray.set(i, origin - center(), direction, kInfinity);
            lanes[i] = -1;
        }
        closest(packet, lanes, coherence);
        for (std::size_t i = 0; i < count; ++i) {
            std::optional<Hit>& hit = hits[first + i];
            hit.reset();
            if (packet.object[i] != kNothing) hit = this->hit(packet, i);
        }
    }
}

void RayCaster::closest(RayHitPacket& packet, const LaneMask& lanes, Coherence coherence) const {
    count(lanes);
    if (implementation_->takes_few_triangles(lanes, coherence))
        return implementation_->few_triangles->closest(packet, lanes);
    if (implementation_->takes_single_rays()) return implementation_->closest_by_single_rays(packet, lanes);
    RTCIntersectContext context = context_for(coherence);
    const RTCScene embree_scene = implementation_->embree_scene;
    const RayPacket::Floats ends = packet.ray.end;
    packet.object.fill(kNothing);
    switch (implementation_->structure->packet_width) {
        case 16:
            rtcIntersect16(lanes.data(), embree_scene, &context, reinterpret_cast<RTCRayHit16*>(&packet));
            break;
        case 8:
            intersect_in_parts<8, RTCRayHit8>(packet, lanes, [&](const int* valid, RTCRayHit8* part) {
                rtcIntersect8(valid, embree_scene, &context, part);
            });
            break;
        default:
            intersect_in_parts<4, RTCRayHit4>(packet, lanes, [&](const int* valid, RTCRayHit4* part) {
                rtcIntersect4(valid, embree_scene, &context, part);
            });
    }
    implementation_->pass_edges(packet, ends);
}

Hit RayCaster::hit(const RayHitPacket& packet, std::size_t lane) const {
    return implementation_->hit_of(Implementation::met_by(packet, lane));
}

void RayCaster::surfaces(const RayHitPacket& hits, SurfacePacket& surfaces) const {
    CornerPacket corners{};
    LaneMask is_curved{}, is_inside;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        surfaces.object[i] = hits.object[i];
        surfaces.is_smooth[i] = 0;
        if (hits.object[i] == kNothing) continue;
        const MetObject& met = implementation_->structure->met_objects[hits.object[i]];
        if (met.vertices == nullptr) {
            is_curved[i] = -1;
            continue;
        }
        const Triangle& triangle = met.triangles[hits.primitive[i]];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto& [x, y, z] = met.vertices[triangle[c]];
            LaneVectors& corner = corners.corner[c];
            if (met.placement == nullptr) {
                corner.x[i] = x, corner.y[i] = y, corner.z[i] = z;
            } else {
                corner.set(i, met.placement->point({x, y, z}));
            }
        }
        surfaces.material[i] = index_of(met.material_of(hits.primitive[i]));
        surfaces.is_smooth[i] = met.is_smooth ? -1 : 0;
    }
    find_surfaces(hits, corners, lift(), surfaces, is_inside);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (hits.object[i] == kNothing) continue;
        if (is_curved[i] != 0 || is_inside[i] == 0) {
            surfaces.set(i, hit(hits, i), center());
        } else if (implementation_->has_backs && surfaces.is_on_front[i] == 0) {
            surfaces.material[i] =
                index_of(implementation_->scene.on_side(MaterialId{surfaces.material[i]}, false));
        }
    }
}

std::optional<TracedMesh> RayCaster::traced_mesh(ObjectId object) const {
    const EmbreeGeometry& geometry = *implementation_->geometries[index_of(object)];
    if (geometry.curved || geometry.instance != nullptr) return std::nullopt;
    return TracedMesh{{geometry.vertices, geometry.vertex_count},
                      {geometry.triangles, geometry.triangle_count},
                      geometry.parents};
}

bool RayCaster::is_sealed(const Hit& hit) const {
    const Implementation& all = *implementation_;
    std::call_once(all.sealed_once, [&] { all.is_sealed = sealed_sides(all.scene); });
    return all.is_sealed[ObjectSide{hit.object, hit.on_front}.number()];
}

const Scene& RayCaster::scene() const { return implementation_->scene; }
std::span<const Vec3> RayCaster::measured() const { return implementation_->measured; }

bool RayCaster::has_panes() const { return implementation_->has_panes; }

bool RayCaster::occluded(const Vec3& from, const Vec3& to) const {
    ++traced_by_this_thread;
    return implementation_->occluded(from - center(), to - center());
}

void RayCaster::occlude(RayPacket& packet, const LaneMask& lanes, Coherence coherence) const {
    count(lanes);
    if (implementation_->takes_few_triangles(lanes, coherence))
        return implementation_->few_triangles->occlude(packet, lanes);
    if (implementation_->takes_single_rays()) return implementation_->occlude_by_single_rays(packet, lanes);
    RTCIntersectContext context = context_for(coherence);
    const RTCScene embree_scene = implementation_->embree_scene;
    switch (implementation_->structure->packet_width) {
        case 16:
            rtcOccluded16(lanes.data(), embree_scene, &context, reinterpret_cast<RTCRay16*>(&packet));
            break;
        case 8:
            occlude_in_parts<8, RTCRay8>(packet, lanes, [&](const int* valid, RTCRay8* rays) {
                rtcOccluded8(valid, embree_scene, &context, rays);
            });
            break;
        default:
            occlude_in_parts<4, RTCRay4>(packet, lanes, [&](const int* valid, RTCRay4* rays) {
                rtcOccluded4(valid, embree_scene, &context, rays);
            });
    }
}

std::uint64_t traced_rays() { return traced_by_this_thread; }

}  // namespace stilb::rays
