// Rays against patches: which side of which patch does a ray meet first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "base/sampling.h"
#include "patches/patches.h"
#include "scene/ray_caster.h"

namespace stilb {

/// What sixteen rays met first.
struct PatchHits {
    std::array<std::uint32_t, kPacketWidth> sides;  ///< kNoSide where a ray met nothing, or is not asked for
    RayPacket::Floats b1, b2;                       ///< where on the patch, of those that met one

    Barycentric place(std::size_t lane) const {
        const double u = b1[lane], v = b2[lane];
        return {1 - u - v, u, v};
    }
};

/// Immutable after construction; all queries may run in parallel. Keeps a reference to the patches. Rays that
/// meet the edge between two patches meet one of them (Embree's robust mode).
class PatchCaster {
  public:
    /// Builds the acceleration structure. Throws std::runtime_error where Embree does (out of memory).
    explicit PatchCaster(const Patches& patches);
    ~PatchCaster();
    PatchCaster(const PatchCaster&) = delete;
    PatchCaster& operator=(const PatchCaster&) = delete;

    /// For lanes that are set: what is met first between `start` and `end`; `end` becomes how far it is.
    /// Coordinates are relative to Patches::center. Made for rays that are close together; Embree divides
    /// packets where the processor has narrower vectors.
    PatchHits closest(RayPacket& packet, const LaneMask& lanes) const;

    const Patches& patches() const;
    /// Memory of the acceleration structure.
    std::size_t bytes() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace stilb
