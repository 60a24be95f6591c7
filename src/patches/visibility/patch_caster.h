// Rays against patches: which side of which patch does a ray meet first, and which ones are on its whole way.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "math/sampling.h"
#include "patches/patches.h"
#include "rays/ray_caster.h"

namespace stilb::patches {

/// What sixteen rays met first.
struct PatchHits {
    std::array<std::uint32_t, kPacketWidth> sides;  ///< kNoSide where a ray met nothing, or is not asked for
    RayPacket::Floats b1, b2;                       ///< where on the patch, of those that met one

    math::Barycentric place(std::size_t lane) const {
        const double u = b1[lane], v = b2[lane];
        return {1 - u - v, u, v};
    }
};

/// A patch on the way of a ray.
struct Crossing {
    float distance = 0;            ///< in units of the ray's direction
    std::uint32_t side = kNoSide;  ///< the one that faces the ray's origin

    auto operator<=>(const Crossing&) const = default;
};

/// For each ray of a packet.
using PacketCrossings = std::array<std::vector<Crossing>, kPacketWidth>;

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
    /// Coordinates are relative to Patches::center. Embree divides packets where the processor has narrower
    /// vectors.
    PatchHits closest(RayPacket& packet, const LaneMask& lanes,
                      rays::Coherence coherence = rays::Coherence::coherent) const;

    /// For lanes that are set: all that is met between `start` and `end`, by distance; other lanes have
    /// nothing. Takes the place of what was in `crossings`, whose memory can so be used again. A ray on the
    /// edge between patches meets one or more of them.
    void all(const RayPacket& packet, const LaneMask& lanes, PacketCrossings& crossings) const;

    const Patches& patches() const;
    /// Memory of the acceleration structure.
    std::size_t bytes() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace stilb::patches
