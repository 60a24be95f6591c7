// Rays, and both backends, for tests that hold for either.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "patches/visibility/bundle.h"
#include "patches/visibility/item_buffer.h"
#include "patches/visibility/opengl.h"
#include "stilb/error.h"

namespace stilb::patches {

inline std::string name_of_backend(const testing::TestParamInfo<BufferBackend>& test) {
    return std::string(name_of(test.param));
}

/// Why this machine has no OpenGL, where it has none.
inline std::optional<std::string> missing_opengl() {
    try {
        const OpenGlContext context;
        return std::nullopt;
    } catch (const InputError& error) {
        return error.what();
    }
}

/// One ray of a packet, without an end; the origin is relative to the patches' centre.
inline void set_ray(RayPacket& rays, std::size_t lane, const Vec3& origin, const Vec3& direction) {
    rays.origin_x[lane] = static_cast<float>(origin.x),
    rays.direction_x[lane] = static_cast<float>(direction.x);
    rays.origin_y[lane] = static_cast<float>(origin.y),
    rays.direction_y[lane] = static_cast<float>(direction.y);
    rays.origin_z[lane] = static_cast<float>(origin.z),
    rays.direction_z[lane] = static_cast<float>(direction.z);
    rays.end[lane] = std::numeric_limits<float>::infinity();
}

inline std::vector<std::uint32_t> filled(ItemBuffers& buffers, const ItemBufferLayout& layout,
                                         const Viewpoint& viewpoint) {
    std::vector<std::uint32_t> sides(layout.pixel_count());
    buffers.fill(layout, viewpoint, sides);
    return sides;
}

}  // namespace stilb::patches
