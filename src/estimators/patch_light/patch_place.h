// Where on the patches something is that was found on the true surfaces.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "patches/visibility/patch_caster.h"
#include "rays/ray_caster.h"

namespace stilb {

struct PatchPlace {
    std::uint32_t side = 0;
    Barycentric place;
};

/// A point of a true surface, seen from the unit direction `outgoing`.
struct SeenPoint {
    Hit hit;
    Vec3 outgoing;
};

/// The places on patches that stand for points. Where the patches of a curved surface leave one out, at its
/// outline, what is behind stands for it; nothing where there is nothing. `coherence`: of the ways that
/// neighbouring points are seen along.
std::vector<std::optional<PatchPlace>> find_places(const PatchCaster& caster,
                                                   std::span<const SeenPoint> points,
                                                   Coherence coherence = Coherence::coherent);

}  // namespace stilb
