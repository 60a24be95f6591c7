// Sixteen rays at once, in single precision.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/vec.h"

namespace stilb {

inline constexpr int kPacketWidth = 16;

/// Which lanes of a packet take part: -1 yes, 0 no (Embree's convention).
struct alignas(64) LaneMask : std::array<std::int32_t, kPacketWidth> {};

/// A direction's component as packets have it. Embree 3.13 loses whole coherent packets in which one is
/// between 1e-18 and 1e-12 (as the cosines of right angles are), with both signs; 0 is safe.
inline float packet_direction(double component) {
    return std::abs(component) < 1e-11 ? 0 : static_cast<float>(component);
}

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

/// What single precision tells for certain of a ray and a part of a surface.
enum class Classification : std::int32_t {
    unclear,
    misses,  ///< the part
    meets,   ///< the surface, there or next to the part
};
struct alignas(64) LaneVerdicts : std::array<Classification, kPacketWidth> {};

/// Takes packets to the axes and units of a body: x goes to axes (x - center).
struct PacketPlacement {
    std::array<std::array<float, 3>, 3> axes{};
    std::array<float, 3> center{};
};

}  // namespace stilb
