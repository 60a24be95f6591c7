// Sixteen rays at once, in single precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/vec.h"

// Sanitizers instrument the dispatch code, which runs before they are ready.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)
#define STILB_VECTORIZED __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define STILB_VECTORIZED
#endif
// For what is called in the loops of such functions: a call that is not inlined would keep them scalar.
#define STILB_INLINED [[gnu::always_inline]] inline

namespace stilb {

inline constexpr int kPacketWidth = 16;

/// The active lanes of a packet: -1 active, 0 inactive (Embree's convention).
struct alignas(64) LaneMask : std::array<std::int32_t, kPacketWidth> {};

/// A direction's component for packets. Embree 3.13 loses whole coherent packets with a component
/// between 1e-18 and 1e-12 (as the cosines of right angles are), with both signs; 0 is safe.
inline float packet_direction(double component) {
    return std::abs(component) < 1e-11 ? 0 : static_cast<float>(component);
}

/// The same of components that are computed in single precision.
STILB_INLINED float lane_direction(float component) { return std::abs(component) < 1e-11f ? 0 : component; }

/// Sixteen rays as a structure of arrays, in the memory layout of Embree's RTCRay16: lengths count in units
/// of `direction`. Coordinates are relative to RayCaster::center().
struct alignas(64) RayPacket {
    using Floats = std::array<float, kPacketWidth>;
    using Words = std::array<std::uint32_t, kPacketWidth>;
    Floats origin_x{}, origin_y{}, origin_z{}, start{};
    Floats direction_x{}, direction_y{}, direction_z{}, time{};
    Floats end{};
    Words mask, id{}, flags{};

    RayPacket() { mask.fill(~0u); }

    void set(std::size_t lane, const Vec3& origin, const Vec3& direction, float length) {
        origin_x[lane] = static_cast<float>(origin.x), origin_y[lane] = static_cast<float>(origin.y);
        origin_z[lane] = static_cast<float>(origin.z), direction_x[lane] = packet_direction(direction.x);
        direction_y[lane] = packet_direction(direction.y);
        direction_z[lane] = packet_direction(direction.z);
        end[lane] = length;
    }
};

/// The certain results in single precision for a ray and a part of a surface.
enum class Classification : std::int32_t {
    unclear,
    misses,  ///< the part
    meets,   ///< the surface, there or next to the part
};
struct alignas(64) LaneClassifications : std::array<Classification, kPacketWidth> {};

/// Takes packets to the axes and units of a body: x goes to axes (x - center).
struct PacketPlacement {
    std::array<std::array<float, 3>, 3> axes{};
    std::array<float, 3> center{};
};

// Lifting of points off their surfaces, so that rays from there do not meet these again.

/// Ray queries work in single precision on coordinates relative to a centre: 2^-19 of the largest number
/// involved is some 30 times the rounding error. Things near the centre are seen from afar, where rounding is
/// coarser: see least_size_m().
class Lift {
  public:
    Lift() = default;
    /// The rule for a scene around `center`. `half_extent_m`: its largest coordinate relative to that, and
    /// that of measured points. `nearest_m`: all measured points are at least so far from the centre.
    /// `near_extent_m`: the extent of what is near to them, before a gap, where there is one.
    Lift(const Vec3& center, double half_extent_m, double nearest_m = 0,
         double near_extent_m = kFarthestEnd_m)
        : center_(center),
          half_extent_m_(half_extent_m),
          nearest_m_(nearest_m),
          near_extent_m_(std::min(near_extent_m, kFarthestEnd_m)) {}

    const Vec3& center() const { return center_; }
    double half_extent_m() const { return half_extent_m_; }
    /// Points on smaller things that are nearer to the centre are lifted as if on something of this size: the
    /// rounding error of a shadow ray to them is that of its far end. In scenes of more than 64 m it is that
    /// of ends up to 32 m away, so that a house on a large ground is as exact as one alone; but where nothing
    /// is measured within such a distance, things are lifted for those who see them. Ends beyond a gap do not
    /// count: shadow rays from there end above the surface by a share of their length (point_tile.cpp).
    double least_size_m() const { return std::max(largest_size_m(), nearest_m_) / 4; }
    /// For points on things of unknown size: near the centre none is larger (geometry/cut.h), and elsewhere
    /// the distance from there counts.
    double largest_size_m() const { return std::min(half_extent_m_, near_extent_m_); }
    /// For points that may be anywhere up to 256 m from the centre, or as much nearer as there is a gap: half
    /// a millimetre at most.
    double common_offset_m() const { return kShare * std::min(half_extent_m_, 8 * near_extent_m_); }
    /// The distance by which a point near `position` on something of size `size_m` is lifted.
    double offset_m(const Vec3& position, double size_m) const {
        return relative_offset_m(position - center_, size_m);
    }
    /// The same for a position relative to the centre.
    double relative_offset_m(const Vec3& relative, double size_m) const {
        return kShare * std::max({std::abs(relative.x), std::abs(relative.y), std::abs(relative.z), size_m,
                                  least_size_m()});
    }
    /// The same for the end of a ray that starts `distance_m` away: its origin, its direction and the place
    /// where it meets a surface are rounded by 2^-24 of that, each several times.
    double offset_m(const Vec3& position, double size_m, double distance_m) const {
        return offset_m(position, std::max(size_m, kShareOfRay * distance_m));
    }
    static constexpr double kShare = 0x1p-19;
    static constexpr double kShareOfRay = 0x1p-2;

  private:
    static constexpr double kFarthestEnd_m = 32;
    Vec3 center_;
    double half_extent_m_ = 0, nearest_m_ = 0, near_extent_m_ = kFarthestEnd_m;
};

}  // namespace stilb
