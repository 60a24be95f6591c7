// Ray queries: closest hit, occlusion, and packets of both. Only this implementation, and that of
// patches/visibility/patch_caster.h, includes Embree.
//
// Offsets. Embree works in single precision on coordinates relative to a centre. Rays start from,
// and connections end at, points that are lifted off their surface along its geometric normal by offset_m() =
// 2^-19 of the largest number involved (distance from the centre, size of the triangle): some 30 times the
// rounding error, 8 micrometres in a room of 8 m, and the same in proportion at any size. Before they are
// lifted, points are moved away from the edges of their triangle by eight times that, so that lifting never
// carries them through a neighbouring wall. With Embree's robust (watertight) mode nothing else is needed:
// rays have no minimal length. Distances and angles are those of the points themselves, not of the lifted
// ones.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/monitor.h"
#include "base/rays.h"
#include "base/surface_point.h"
#include "base/vec.h"
#include "rays/surface_packet.h"
#include "scene/scene.h"

namespace stilb::rays {

/// A hit of a ray on a surface: its side that the ray came from, with the geometric normal.
struct Hit : SurfacePoint {
    /// The normal of the smooth surface that a mesh with vertex normals approximates, unit, less than a right
    /// angle from `normal`; else `normal`. Only materials use it (materials/shaded_surface.h).
    Vec3 shading_normal;
    double lift_m = 0;  ///< distance of `lifted` from `position`
    double distance_m = 0;
    ObjectId object{};
    MaterialId material{};
    std::uint32_t triangle = 0;  ///< of the mesh, or of the triangulated() rectangle or box; else 0
    bool on_front = true;

    /// The counterpart of `lifted` on the other side.
    Vec3 lifted_behind() const { return lifted - 2 * lift_m * normal; }
    /// The same place on the other side.
    Hit behind() const {
        Hit result = *this;
        result.lifted = lifted_behind();
        result.normal = -normal, result.shading_normal = -shading_normal;
        result.on_front = !on_front;
        return result;
    }
    /// A direction, mirrored at the surface.
    Vec3 mirrored(const Vec3& direction) const { return direction - 2 * dot(direction, normal) * normal; }
};

/// A surface that a ray crosses.
struct Crossing {
    ObjectId object{};
    MaterialId material{};
    std::uint32_t triangle = 0;  ///< as Hit::triangle
};

struct Ray {
    Vec3 origin;
    Vec3 direction;  ///< unit
};

/// Between two (lifted) points.
struct Segment {
    Vec3 from, to;
};

/// The triangles by which rays meet an object: those of its mesh, or of the triangulated() rectangle or box,
/// where large ones are cut into parts.
struct TracedMesh {
    std::span<const std::array<float, 3>> vertices;  ///< relative to RayCaster::center()
    std::span<const Triangle> triangles;             ///< as RayHitPacket::primitive numbers them
    std::span<const std::uint32_t> parents;          ///< the mesh's own triangles; empty where none is cut

    std::uint32_t triangle_of(std::uint32_t primitive) const {
        return parents.empty() ? primitive : parents[primitive];
    }
};

/// Whether neighbouring rays of many have similar directions: then they are fastest together, else
/// one by one.
enum class Coherence { coherent, scattered };

/// Immutable after construction; all queries may run in parallel. Keeps a reference to the scene.
class RayCaster {
  public:
    /// Builds the acceleration structure; the monitor takes the share that is built. `measured`: points at
    /// which light is measured, if they are known: rays are most exact near to them (scene::lift_of). Throws
    /// InputError where an object or a light is farther than 1e9 m from the origin, std::runtime_error
    /// where Embree fails (out of memory).
    explicit RayCaster(const Scene& scene, const Monitor& monitor = Monitor::none(),
                       std::span<const Vec3> measured = {});
    /// The same for a scene with the objects and materials of `similar`'s, whose lights may differ, or for
    /// other measured points: takes its acceleration structure where that has the precision. The scene of
    /// `similar` must outlive this.
    RayCaster(const RayCaster& similar, const Scene& scene, const Monitor& monitor,
              std::span<const Vec3> measured);
    ~RayCaster();
    RayCaster(const RayCaster&) = delete;
    RayCaster& operator=(const RayCaster&) = delete;

    /// The first surface that a ray from `origin` along the unit vector `direction` meets.
    std::optional<Hit> closest(const Vec3& origin, const Vec3& direction) const;
    /// All surfaces that the ray crosses, in any order; of several in one plane each.
    std::vector<Crossing> crossings(const Vec3& origin, const Vec3& direction) const;
    /// The closest hits of many rays, into as many.
    void closest(std::span<const Ray> rays, Coherence coherence, std::span<std::optional<Hit>> hits) const;

    /// The same of a packet, for lanes that are set; directions need not be unit vectors, and components as
    /// in packet_direction(). `start`, `end` and the direction are the caller's, `hit` and `end` the result.
    void closest(RayHitPacket& packet, const LaneMask& lanes, Coherence coherence) const;
    /// The surface points of a packet's hits.
    void surfaces(const RayHitPacket& hits, SurfacePacket& surfaces) const;
    /// The whole hit of a lane that has met something.
    Hit hit(const RayHitPacket& packet, std::size_t lane) const;

    const Scene& scene() const;
    /// The points at which light is measured, as they were given.
    std::span<const Vec3> measured() const;
    /// Whether segments may pass through surfaces (transmittance()).
    bool has_panes() const;
    /// True where a surface lies between two (lifted) points.
    bool occluded(const Vec3& from, const Vec3& to) const;
    /// The transmittance along a straight segment: 0 where a surface lies in between, the panes'
    /// transmittance where there is nothing but panes.
    Rgb transmittance(const Segment& segment) const;
    /// The same of many segments.
    void transmittances(std::span<const Segment> segments, Coherence coherence,
                        std::span<Rgb> transmittances) const;

    /// The first surface other than panes along a ray, none where the ray leaves the
    /// scene, and the transmittance of the panes before it.
    struct FirstHit {
        std::optional<Hit> hit;
        Rgb transmittance = Rgb::grey(1);
    };
    FirstHit seen(const Ray& ray) const;

    /// For lanes that are set: `end` becomes negative where a surface is met between `start` and `end`.
    void occlude(RayPacket& packet, const LaneMask& lanes, Coherence coherence = Coherence::coherent) const;

    /// Whether a hit is on the inside of a closed body that no light reaches (scene/sealed_sides.h).
    bool is_sealed(const Hit& hit) const;

    /// The triangles of an object; nothing for curved surfaces and instances.
    std::optional<TracedMesh> traced_mesh(ObjectId object) const;

    /// The origin of packet coordinates: where single precision is best (scene::lift_of).
    const Vec3& center() const;
    /// The largest coordinate relative to the centre [m]; of surfaces, lights and measured points.
    double half_extent_m() const;
    /// The rule for lifting points off surfaces.
    Lift lift() const;
    /// The distance by which a point near `position` on something of size `size_m` is lifted off its surface.
    double offset_m(const Vec3& position, double size_m) const;

  private:
    /// The transmittance of a segment that meets something.
    Rgb transmittance_of_panes(const Segment& segment) const;

    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// The number of rays that this thread has traced so far, with all casters: a measure of work without a
/// clock. Lanes of packets count as rays.
std::uint64_t traced_rays();

}  // namespace stilb::rays
