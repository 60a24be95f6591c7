// Construction of the visibility backends for item buffers and bundles.
#pragma once

#include <memory>

#include "patches/visibility/buffer_options.h"
#include "patches/visibility/bundle.h"
#include "patches/visibility/item_buffer.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::patches {

/// Both keep a reference to the caster or its patches. Throw InputError where OpenGL is requested but
/// missing.
std::unique_ptr<ItemBuffers> make_item_buffers(BufferBackend backend, const PatchCaster& caster);
std::unique_ptr<Bundles> make_bundles(BufferBackend backend, const PatchCaster& caster);

}  // namespace stilb::patches
