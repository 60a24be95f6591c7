// Shapes as Embree's geometries.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "base/rays.h"
#include "base/vec.h"
#include "geometry/shape.h"
#include "rays/ray_caster.h"

namespace stilb::rays {

// Surfaces that rays are intersected with exactly, in double precision, instead of through triangles.

/// The points origin + t direction, start < t < end; the direction need not be a unit vector.
struct RayInterval {
    Vec3 origin, direction;
    double start = 0, end = 0;
};

/// A point on the front of the surface; `size_m` bounds the shape's extent.
struct NearestPoint : SurfacePoint {
    double size_m = 0;
};

/// A surface in parts, each with bounds. Immutable.
class CurvedSurface {
  public:
    virtual ~CurvedSurface() = default;
    virtual std::size_t part_count() const = 0;
    virtual Bounds bounds_of(std::size_t part) const = 0;
    /// Smallest t in the interval at which the ray meets the part, from either side; infinite where it misses
    /// it.
    virtual double intersect(std::size_t part, const RayInterval& ray) const = 0;
    virtual bool has_classifications() const { return false; }
    /// The result of intersect(), as far as it can be classified faster.
    virtual LaneClassifications classifications(std::size_t, const RayPacket&) const { return {}; }
    /// `near_by` (a hit with the rounding error of single precision) projected onto the part.
    virtual NearestPoint nearest_point(std::size_t part, const Vec3& near_by) const = 0;
};

/// The surface of a shape relative to `origin`; null where it is made of triangles.
std::unique_ptr<CurvedSurface> curved_surface(const Shape& shape, const Vec3& origin);

/// The data of a geometry for rays that met it: a mesh in single precision, or a curved surface.
struct EmbreeGeometry {
    const std::array<float, 3>* vertices = nullptr;  ///< owned by Embree; or null
    const Triangle* triangles = nullptr;             ///< of own_triangles, or owned by the scene; or null
    std::size_t vertex_count = 0, triangle_count = 0;
    std::vector<Triangle> own_triangles;
    std::vector<std::uint32_t> parents;  ///< of triangles that are parts of larger ones; empty where none is
    const Mesh* smooth = nullptr;        ///< owned by the scene, where it has vertex normals; or null
    std::unique_ptr<CurvedSurface> curved;
    const Instance* instance = nullptr;  ///< owned by the scene; or null
    /// Of instances: from the coordinates of the vertices to those relative to the scene's origin.
    geometry::Transform placement;
    bool is_mirrored = false;

    /// The shape's own triangle.
    std::uint32_t triangle_of(std::uint32_t primitive) const {
        return parents.empty() ? primitive : parents[primitive];
    }
    /// Relative to the scene's origin, counterclockwise from the front.
    std::array<Vec3, 3> corners_of(std::uint32_t primitive) const;
};

/// The shape relative to `origin`, not committed yet. `kept` is filled and must outlive the geometry and stay
/// where it is. A curved surface's parts are the geometry's primitives.
RTCGeometry new_geometry(RTCDevice device, const Shape& shape, const Vec3& origin, EmbreeGeometry& kept);

/// Throws InputError where an object or a light has a coordinate beyond 1e9 m.
void require_within_reach(const Scene& scene);

/// The meshes of instances, each of which Embree stores once.
class SharedMeshes {
  public:
    SharedMeshes() = default;
    ~SharedMeshes();
    SharedMeshes(const SharedMeshes&) = delete;
    SharedMeshes& operator=(const SharedMeshes&) = delete;

    /// As new_geometry(); a hit on it has the instance's number in instID.
    RTCGeometry new_instance(RTCDevice device, const Instance& instance, const Vec3& origin,
                             EmbreeGeometry& kept);
    bool empty() const { return meshes_.empty(); }

  private:
    /// A scene with one mesh, relative to its middle: single precision is best there.
    struct SharedMesh {
        Vec3 middle;
        EmbreeGeometry geometry;
        RTCScene scene = nullptr;
    };
    const SharedMesh& shared(RTCDevice device, const Mesh& mesh);

    std::map<const Mesh*, SharedMesh> meshes_;
};

/// Watertight, and built for many rays.
RTCScene new_scene(RTCDevice device);
/// Builds a scene. Embree flushes denormal numbers to zero while it does so. Without a loop before, TBB would
/// keep that for all later parallel loops of the calling thread.
void commit(RTCScene scene);

// Data of rays for Embree, for the files that include Embree.

inline RTCIntersectContext context_for(Coherence coherence) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

}  // namespace stilb::rays
