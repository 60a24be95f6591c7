// Rays against patches: the first side that a ray meets, and all sides along the ray.
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

/// The first hits of sixteen rays.
struct PatchHits {
    std::array<std::uint32_t, kPacketWidth>
        sides;                      ///< kNoSide where a ray met no patch, or its lane is not set
    RayPacket::Floats b1, b2;       ///< barycentric coordinates on the patch, for lanes with a hit
    std::uint32_t exact_lanes = 0;  ///< bits of the lanes whose rays met an exact surface

    math::Barycentric barycentric(std::size_t lane) const {
        const double u = b1[lane], v = b2[lane];
        return {1 - u - v, u, v};
    }
};

/// A crossing of a ray with a patch.
struct Crossing {
    float distance = 0;            ///< in units of the ray's direction
    std::uint32_t side = kNoSide;  ///< the one that faces the ray's origin

    auto operator<=>(const Crossing&) const = default;
};

/// Crossings for each ray of a packet.
using PacketCrossings = std::array<std::vector<Crossing>, kPacketWidth>;

/// Immutable after construction; all queries may run in parallel. Keeps a reference to the patches. Rays that
/// meet the edge between two patches meet one of them (Embree's robust mode).
class PatchCaster {
  public:
    /// Builds the acceleration structure. Throws std::runtime_error where Embree does (out of memory).
    explicit PatchCaster(const Patches& patches);
    /// Rays meet what they meet in the scene of the patches: spheres, disks and bodies by harmonics replace
    /// their patches. all() is not for this case.
    PatchCaster(const Patches& patches, const Scene& scene);
    ~PatchCaster();
    PatchCaster(const PatchCaster&) = delete;
    PatchCaster& operator=(const PatchCaster&) = delete;

    /// First hits between `start` and `end`, for lanes that are set; `end` becomes the distance of the hit.
    /// Coordinates are relative to Patches::center. Embree divides packets where the processor has narrower
    /// vectors.
    PatchHits closest(RayPacket& packet, const LaneMask& lanes,
                      rays::Coherence coherence = rays::Coherence::coherent) const;

    /// All crossings between `start` and `end`, by distance, for lanes that are set; other lanes have
    /// none. Overwrites `crossings`, whose memory is reused. A ray on the
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
