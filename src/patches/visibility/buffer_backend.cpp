#include "patches/visibility/buffer_backend.h"

#include "patches/visibility/bundle.h"
#include "patches/visibility/item_buffer.h"
#include "patches/visibility/opengl.h"

namespace stilb::patches {

std::unique_ptr<ItemBuffers> make_item_buffers(BufferBackend backend, const PatchCaster& caster) {
    if (backend == BufferBackend::rays) return std::make_unique<RayItemBuffers>(caster);
    return std::make_unique<OpenGlItemBuffers>(caster.patches());
}

std::unique_ptr<Bundles> make_bundles(BufferBackend backend, const PatchCaster& caster) {
    if (backend == BufferBackend::rays) return std::make_unique<RayBundles>(caster);
    return std::make_unique<OpenGlBundles>(caster.patches());
}

}  // namespace stilb::patches
