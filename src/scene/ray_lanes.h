// Rays as Embree hands them to curved surfaces: up to sixteen at once, in single precision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace stilb {

inline constexpr std::size_t kMostLanes = 16;

template <typename T>
struct alignas(64) Lanes : std::array<T, kMostLanes> {};

/// A structure of arrays. Directions may have any length but 0.
struct RayLanes {
    Lanes<float> origin_x{}, origin_y{}, origin_z{};
    Lanes<float> direction_x{}, direction_y{}, direction_z{};
    Lanes<float> start{}, end{};
};

/// What single precision tells for certain of a ray and a part of a surface.
enum class Verdict : std::int32_t {
    unclear,
    misses,  ///< the part
    meets,   ///< the surface, there or next to the part
};

/// Takes rays to the axes and units of a body: x goes to axes (x - center).
struct LanePlacement {
    std::array<std::array<float, 3>, 3> axes{};
    std::array<float, 3> center{};
};

}  // namespace stilb
