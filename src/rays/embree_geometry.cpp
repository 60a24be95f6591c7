#include "rays/embree_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "base/parallel.h"
#include "geometry/cut.h"
#include "scene/scene.h"
#include "stilb/error.h"

namespace stilb::rays {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Triangles up to this size lift points by 15 micrometres at most, near the centre: little beside the
/// distances of lighting. Smaller rooms stay as they are.
constexpr double kLargeTriangle_m = 8;
/// As readers of files have it: products of four lengths are far from overflow in single precision.
constexpr double kFarthest_m = 1e9;

/// The common data of a curved surface's callbacks for N rays, at lane i.
RayInterval interval_of(RTCRayN* rays, unsigned width, unsigned lane) {
    return {{RTCRayN_org_x(rays, width, lane), RTCRayN_org_y(rays, width, lane),
             RTCRayN_org_z(rays, width, lane)},
            {RTCRayN_dir_x(rays, width, lane), RTCRayN_dir_y(rays, width, lane),
             RTCRayN_dir_z(rays, width, lane)},
            RTCRayN_tnear(rays, width, lane),
            RTCRayN_tfar(rays, width, lane)};
}

const CurvedSurface& surface_of(const void* user_data) {
    return *static_cast<const CurvedSurface*>(user_data);
}

void curved_bounds(const RTCBoundsFunctionArguments* args) {
    const Bounds bounds = surface_of(args->geometryUserPtr).bounds_of(args->primID);
    // Rounded outwards, so that the box in single precision holds the part.
    const auto below = [](double v) { return std::nextafter(static_cast<float>(v), -kInfinity); };
    const auto above = [](double v) { return std::nextafter(static_cast<float>(v), kInfinity); };
    RTCBounds& out = *args->bounds_o;
    out.lower_x = below(bounds.min.x), out.upper_x = above(bounds.max.x);
    out.lower_y = below(bounds.min.y), out.upper_y = above(bounds.max.y);
    out.lower_z = below(bounds.min.z), out.upper_z = above(bounds.max.z);
}

/// Up to 16 rays.
RayPacket packet_of(RTCRayN* rays, unsigned width) {
    RayPacket packet;
    const auto copy = [width](const float& first, RayPacket::Floats& copies) {
        std::copy_n(&first, width, copies.begin());
    };
    copy(RTCRayN_org_x(rays, width, 0), packet.origin_x);
    copy(RTCRayN_org_y(rays, width, 0), packet.origin_y);
    copy(RTCRayN_org_z(rays, width, 0), packet.origin_z);
    copy(RTCRayN_dir_x(rays, width, 0), packet.direction_x);
    copy(RTCRayN_dir_y(rays, width, 0), packet.direction_y);
    copy(RTCRayN_dir_z(rays, width, 0), packet.direction_z);
    copy(RTCRayN_tnear(rays, width, 0), packet.start);
    copy(RTCRayN_tfar(rays, width, 0), packet.end);
    return packet;
}

/// Unclear for single rays, which are faster without classification.
LaneClassifications classifications_of(const CurvedSurface& surface, unsigned part, RTCRayN* rays,
                                       unsigned width) {
    if (width == 1 || !surface.has_classifications()) return {};
    return surface.classifications(part, packet_of(rays, width));
}

/// The normal is found once the ray's closest hit is known.
void curved_intersect(const RTCIntersectFunctionNArguments* args) {
    const CurvedSurface& surface = surface_of(args->geometryUserPtr);
    RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
    RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
    const LaneClassifications classifications = classifications_of(surface, args->primID, rays, args->N);
    for (unsigned lane = 0; lane < args->N; ++lane) {
        if (args->valid[lane] == 0 || classifications[lane] == Classification::misses) continue;
        const double t = surface.intersect(args->primID, interval_of(rays, args->N, lane));
        if (t == std::numeric_limits<double>::infinity()) continue;
        RTCRayN_tfar(rays, args->N, lane) = static_cast<float>(t);
        RTCHitN_geomID(hits, args->N, lane) = args->geomID;
        RTCHitN_primID(hits, args->N, lane) = args->primID;
        RTCHitN_instID(hits, args->N, lane, 0) = RTC_INVALID_GEOMETRY_ID;
    }
}

void curved_occluded(const RTCOccludedFunctionNArguments* args) {
    const CurvedSurface& surface = surface_of(args->geometryUserPtr);
    const LaneClassifications classifications = classifications_of(surface, args->primID, args->ray, args->N);
    for (unsigned lane = 0; lane < args->N; ++lane) {
        if (args->valid[lane] == 0 || classifications[lane] == Classification::misses) continue;
        if (classifications[lane] == Classification::meets ||
            surface.intersect(args->primID, interval_of(args->ray, args->N, lane)) <
                std::numeric_limits<double>::infinity())
            RTCRayN_tfar(args->ray, args->N, lane) = -kInfinity;
    }
}

/// `triangles` must stay where they are.
RTCGeometry new_mesh(RTCDevice device, std::span<const Vec3> points, std::span<const Triangle> triangles,
                     const Vec3& origin, EmbreeGeometry& kept) {
    using Vertex = std::array<float, 3>;
    const RTCGeometry handle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<Vertex*>(rtcSetNewGeometryBuffer(
        handle, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vertex), points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 p = points[i] - origin;
        vertices[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    rtcSetSharedGeometryBuffer(handle, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0,
                               sizeof(Triangle), triangles.size());
    kept.vertices = vertices;
    kept.triangles = triangles.data();
    kept.vertex_count = points.size();
    kept.triangle_count = triangles.size();
    return handle;
}

/// A mesh of the scene, whose triangles are not copied where none has to be cut.
RTCGeometry new_mesh(RTCDevice device, const Mesh& mesh, const Vec3& origin, EmbreeGeometry& kept) {
    if (!geometry::has_large_triangles(mesh, origin, kLargeTriangle_m))
        return new_mesh(device, mesh.vertices, mesh.triangles, origin, kept);
    geometry::CutTriangles parts = geometry::cut_large_triangles(mesh, origin, kLargeTriangle_m);
    kept.parents = std::move(parts.parents);
    kept.own_triangles = std::move(parts.triangles);
    return new_mesh(device, parts.vertices, kept.own_triangles, origin, kept);
}

/// A mesh of another shape.
RTCGeometry new_triangulated(RTCDevice device, Mesh mesh, const Vec3& origin, EmbreeGeometry& kept) {
    const RTCGeometry handle = new_mesh(device, mesh, origin, kept);
    if (kept.parents.empty()) {
        kept.own_triangles = std::move(mesh.triangles);  // they stay where they are
    }
    return handle;
}

RTCGeometry new_curved(RTCDevice device, const EmbreeGeometry& kept) {
    const RTCGeometry handle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(handle, static_cast<unsigned>(kept.curved->part_count()));
    rtcSetGeometryUserData(handle, kept.curved.get());
    rtcSetGeometryBoundsFunction(handle, curved_bounds, nullptr);
    rtcSetGeometryIntersectFunction(handle, curved_intersect);
    rtcSetGeometryOccludedFunction(handle, curved_occluded);
    return handle;
}

}  // namespace

void require_within_reach(const Scene& scene) {
    const auto require = [](std::string_view kind, const std::string& name, const Vec3& at) {
        const double farthest_m = largest_coordinate(at);
        if (farthest_m <= kFarthest_m) return;
        throw InputError(fmt::format(
            "{} \"{}\" reaches a coordinate of {:.2g} m; up to 1e9 m are possible. Check the units: Stilb "
            "expects metres.",
            kind, name, farthest_m));
    };
    for (const Object& object : scene.objects) {
        const Bounds bounds = geometry::bounds_of(object.shape);
        if (bounds.is_empty()) continue;
        require("object", object.name, bounds.min);
        require("object", object.name, bounds.max);
    }
    for (const Light& light : scene.lights) {
        if (const auto origin = lights::point_origin(light)) require("light", light.name, origin->position);
    }
}

RTCGeometry new_geometry(RTCDevice device, const Shape& shape, const Vec3& origin, EmbreeGeometry& kept) {
    kept.curved = curved_surface(shape, origin);
    if (kept.curved) return new_curved(device, kept);
    if (const auto* rectangle = std::get_if<Rectangle>(&shape))
        return new_triangulated(device, triangulated(*rectangle), origin, kept);
    if (const auto* box = std::get_if<Box>(&shape))
        return new_triangulated(device, triangulated(*box), origin, kept);
    const Mesh& mesh = std::get<Mesh>(shape);
    if (!mesh.normals.empty()) kept.smooth = &mesh;
    return new_mesh(device, mesh, origin, kept);
}

std::array<Vec3, 3> EmbreeGeometry::corners_of(std::uint32_t primitive) const {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& [x, y, z] = vertices[triangles[primitive][i]];
        corners[i] = {x, y, z};
        if (instance != nullptr) corners[i] = placement.point(corners[i]);
    }
    if (is_mirrored) std::swap(corners[1], corners[2]);
    return corners;
}

RTCScene new_scene(RTCDevice device) {
    const RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    return scene;
}

void commit(RTCScene scene) {
    parallel_for(1, [](std::size_t) {});
    rtcCommitScene(scene);
}

SharedMeshes::~SharedMeshes() {
    for (const auto& [mesh, shared] : meshes_) rtcReleaseScene(shared.scene);
}

const SharedMeshes::SharedMesh& SharedMeshes::shared(RTCDevice device, const Mesh& mesh) {
    const auto [found, is_new] = meshes_.try_emplace(&mesh);
    SharedMesh& shared = found->second;
    if (!is_new) return shared;
    Bounds bounds;
    for (const Vec3& vertex : mesh.vertices) bounds.include(vertex);
    shared.middle = bounds.middle();
    shared.scene = new_scene(device);
    const RTCGeometry geometry =
        new_mesh(device, mesh.vertices, mesh.triangles, shared.middle, shared.geometry);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(shared.scene, geometry);
    rtcReleaseGeometry(geometry);
    commit(shared.scene);
    return shared;
}

RTCGeometry SharedMeshes::new_instance(RTCDevice device, const Instance& instance, const Vec3& origin,
                                       EmbreeGeometry& kept) {
    const SharedMesh& mesh = shared(device, *instance.mesh);
    const geometry::Transform& to_world = instance.to_world;
    std::array<float, 12> columns;
    float* next = columns.data();
    for (const Vec3& column :
         {to_world.x_axis, to_world.y_axis, to_world.z_axis, to_world.point(mesh.middle) - origin}) {
        for (const double value : {column.x, column.y, column.z}) *next++ = static_cast<float>(value);
    }
    const auto column = [&](std::size_t i) { return Vec3{columns[i], columns[i + 1], columns[i + 2]}; };
    kept.vertices = mesh.geometry.vertices;
    kept.triangles = mesh.geometry.triangles;
    kept.vertex_count = mesh.geometry.vertex_count;
    kept.triangle_count = mesh.geometry.triangle_count;
    if (!instance.mesh->normals.empty()) kept.smooth = instance.mesh.get();
    kept.instance = &instance;
    kept.placement = {column(0), column(3), column(6), column(9)};  // as Embree has it
    kept.is_mirrored = to_world.is_mirrored();
    const RTCGeometry handle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(handle, mesh.scene);
    rtcSetGeometryTransform(handle, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    return handle;
}

}  // namespace stilb::rays
