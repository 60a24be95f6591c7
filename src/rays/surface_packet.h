// Sixteen hits at once: what Embree finds, and the surface points of it in single precision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/rays.h"
#include "base/vec.h"

namespace stilb::rays {

struct Hit;

inline constexpr std::uint32_t kNothing = ~0u;

/// Rays and their first hits, in the memory layout of Embree's RTCRayHit16.
struct alignas(64) RayHitPacket {
    using Floats = RayPacket::Floats;
    using Words = RayPacket::Words;
    RayPacket ray;
    Floats normal_x, normal_y, normal_z, u, v;
    Words primitive, object, instance;  ///< `object`: kNothing where nothing is met
};

/// Three coordinates of each lane.
struct alignas(64) LaneVectors {
    RayPacket::Floats x, y, z;

    void set(std::size_t lane, const Vec3& v) {
        x[lane] = static_cast<float>(v.x), y[lane] = static_cast<float>(v.y),
        z[lane] = static_cast<float>(v.z);
    }
    Vec3 at(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
};

/// Hits as Hit has them, in single precision; positions are relative to RayCaster::center().
struct alignas(64) SurfacePacket {
    LaneVectors position, normal, lifted;
    RayPacket::Words object, material;  ///< object: kNothing where a lane's ray meets nothing
    /// -1 where the shading normal may differ from the normal.
    LaneMask is_smooth;
    LaneMask is_on_front;

    void set(std::size_t lane, const Hit& hit, const Vec3& center);
};

/// The corners of the triangles that are met.
struct alignas(64) CornerPacket {
    std::array<LaneVectors, 3> corner;
};

/// The surface points of hits on triangles, by their corners. Sets `is_inside` where a hit is so far from all
/// edges that its lifted point needs no care (ray_caster.h); other lanes are not finished.
void find_surfaces(const RayHitPacket& hits, const CornerPacket& corners, const Lift& lift,
                   SurfacePacket& surfaces, LaneMask& is_inside);

/// Hits are moved away from edges by so many offsets: lifted points stay on this side of neighbours at up to
/// 7 degrees.
inline constexpr double kEdgeMargin = 8;

}  // namespace stilb::rays
