// Who fills item buffers and casts bundles.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>

#include "patches/visibility/bundle.h"
#include "patches/visibility/item_buffer.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::patches {

enum class BufferBackend { rays, opengl };

inline constexpr std::array<std::string_view, 2> kBufferBackendNames{"rays", "opengl"};
constexpr std::string_view name_of(BufferBackend backend) {
    return kBufferBackendNames[static_cast<std::size_t>(backend)];
}

/// Both keep a reference to the caster or its patches. Throw InputError where OpenGL is asked for and
/// missing.
std::unique_ptr<ItemBuffers> make_item_buffers(BufferBackend backend, const PatchCaster& caster);
std::unique_ptr<Bundles> make_bundles(BufferBackend backend, const PatchCaster& caster);

}  // namespace stilb::patches
