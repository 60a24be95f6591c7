// Item buffers by rays.
#pragma once

#include "patches/visibility/item_buffer.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::patches {

/// Fills buffers on one thread; each thread may have an object of its own, they are light. Keeps a reference
/// to the caster.
class RayItemBuffers : public ItemBuffers {
  public:
    explicit RayItemBuffers(const PatchCaster& caster) : caster_(caster) {}

    void fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
              std::span<std::uint32_t> sides) override;

  private:
    const PatchCaster& caster_;
};

}  // namespace stilb::patches
