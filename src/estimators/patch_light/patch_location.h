// Where on the patches something is that was found on the true surfaces.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "patches/visibility/patch_caster.h"
#include "rays/ray_caster.h"

namespace stilb::estimators {

struct PatchLocation {
    std::uint32_t side = 0;
    math::Barycentric place;
};

/// A point of a true surface, seen from the unit direction `outgoing`.
struct ViewedHit {
    rays::Hit hit;
    Vec3 outgoing;
};

/// The places on patches that stand for points. Where the patches of a curved surface leave one out, at its
/// outline, what is behind stands for it; nothing where there is nothing. `coherence`: of the ways that
/// neighbouring points are seen along.
std::vector<std::optional<PatchLocation>> find_patch_locations(
    const patches::PatchCaster& caster, std::span<const ViewedHit> points,
    rays::Coherence coherence = rays::Coherence::coherent);

}  // namespace stilb::estimators
