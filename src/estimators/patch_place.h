// Where on the patches something is that was found on the true surfaces.
#pragma once

#include <optional>

#include "patches/patch_caster.h"
#include "scene/ray_caster.h"

namespace stilb {

struct PatchPlace {
    std::uint32_t side = 0;
    Barycentric place;
};

/// The place on a patch that stands for `hit`, seen from the unit direction `outgoing`; nothing where the
/// patches of a curved surface leave it out, at its outline.
std::optional<PatchPlace> find_place(const PatchCaster& caster, const Hit& hit, const Vec3& outgoing);

}  // namespace stilb
