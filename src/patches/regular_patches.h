// Patches that divide each triangle of the scene regularly, into n x n smaller ones of its shape: so the
// patch at a hit follows from the hit's barycentric coordinates.
//
// Rays meet the scene's own triangles. These are far fewer than the patches, and a ray takes a half to a
// quarter of its time among the patches (docs/lab-book.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "patches/patches.h"
#include "patches/visibility/patch_caster.h"
#include "rays/ray_caster.h"

namespace stilb::patches {

/// Immutable after construction; all queries may run in parallel. Keeps a reference to the caster.
class RegularPatches {
  public:
    /// Whether an object's surface of a material is to have patches.
    using HasPatches = std::function<bool(ObjectId, MaterialId)>;

    /// About `count` patches; more where the scene has many triangles. Curved surfaces have none.
    RegularPatches(const Scene& scene, const rays::RayCaster& caster, double count,
                   const HasPatches& has_patches, const Monitor& monitor);

    /// Relative to RayCaster::center().
    const Patches& patches() const { return patches_; }

    /// First hits, as of RayCaster::closest(), and what is met. `exact_lanes`: where it has no patches.
    PatchHits closest(rays::RayHitPacket& packet, const LaneMask& lanes, rays::Coherence coherence) const;

  private:
    /// The patches of one of the caster's triangles.
    struct Division {
        std::uint32_t first = kNoSide;
        std::uint32_t parts = 0;  ///< n; 0: none
    };

    void add(const Object& object, ObjectId id, double patch_area_m2, const HasPatches& has_patches);

    const rays::RayCaster& caster_;
    Patches patches_;
    std::vector<std::uint32_t> first_division_;  ///< per object; kNoSide for curved ones
    std::vector<Division> divisions_;            ///< of the caster's triangles
};

}  // namespace stilb::patches
