#include "patches/buffer_backend.h"

#include "patches/opengl_item_buffers.h"
#include "patches/ray_item_buffers.h"

namespace stilb {

std::unique_ptr<ItemBuffers> make_item_buffers(BufferBackend backend, const PatchCaster& caster) {
    if (backend == BufferBackend::rays) return std::make_unique<RayItemBuffers>(caster);
    return std::make_unique<OpenGlItemBuffers>(caster.patches());
}

}  // namespace stilb
