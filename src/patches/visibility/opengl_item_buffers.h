// Item buffers by the graphics card.
#pragma once

#include <memory>
#include <string>

#include "patches/patches.h"
#include "patches/visibility/item_buffer.h"

namespace stilb::patches {

/// Draws the patches with their number as colour, without a window, by Mesa's software where there is no
/// card. One buffer at a time, from any thread. Copies of the patches' geometry go to the driver.
class OpenGlItemBuffers : public ItemBuffers {
  public:
    /// Throws InputError where there is no OpenGL 4.5 (OpenGlContext).
    explicit OpenGlItemBuffers(const Patches& patches);
    ~OpenGlItemBuffers() override;

    /// Throws InputError where the driver has no pictures of that size, std::runtime_error where OpenGL fails
    /// (out of memory).
    void fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
              std::span<std::uint32_t> sides) override;

    /// Who draws, for reports: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace stilb::patches
