// Rays, and both ways of filling item buffers, for tests that hold for either.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "patches/opengl_bundles.h"
#include "patches/opengl_context.h"
#include "patches/opengl_item_buffers.h"
#include "patches/ray_bundles.h"
#include "patches/ray_item_buffers.h"

namespace stilb {

enum class Backend { rays, opengl };

inline std::string name_of_backend(const testing::TestParamInfo<Backend>& test) {
    return test.param == Backend::rays ? "rays" : "opengl";
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

inline std::unique_ptr<ItemBuffers> make_item_buffers(Backend backend, const PatchCaster& caster) {
    if (backend == Backend::rays) return std::make_unique<RayItemBuffers>(caster);
    return std::make_unique<OpenGlItemBuffers>(caster.patches());
}

inline std::unique_ptr<Bundles> make_bundles(Backend backend, const PatchCaster& caster) {
    if (backend == Backend::rays) return std::make_unique<RayBundles>(caster);
    return std::make_unique<OpenGlBundles>(caster.patches());
}

inline std::vector<std::uint32_t> filled(ItemBuffers& buffers, const ItemBufferLayout& layout,
                                         const Viewpoint& viewpoint) {
    std::vector<std::uint32_t> sides(layout.pixel_count());
    buffers.fill(layout, viewpoint, sides);
    return sides;
}

}  // namespace stilb
