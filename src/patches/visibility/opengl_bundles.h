// Bundles by the graphics card.
#pragma once

#include <memory>
#include <string>

#include "patches/patches.h"
#include "patches/visibility/bundle.h"

namespace stilb::patches {

/// Draws the patches without perspective, layer behind layer, until nothing is left to draw; without a card
/// by Mesa's software. A pixel's middle is a line. Casts may run in parallel, but draw one after another.
/// Copies of the patches' geometry go to the driver. Distances are right to 2^-8 of the spacing, as measured
/// across the patch.
class OpenGlBundles : public Bundles {
  public:
    /// Throws InputError where there is no OpenGL 4.5 (OpenGlContext).
    explicit OpenGlBundles(const Patches& patches);
    ~OpenGlBundles() override;

    /// Throws std::runtime_error too, where OpenGL fails (out of memory).
    void cast(const Bundle& bundle, const LineVisitor& visit) const override;

    /// Who draws, for reports: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace stilb::patches
