// Places to look from.
#pragma once

#include "base/vec.h"
#include "math/sampling.h"
#include "patches/patches.h"

namespace stilb::patches {

/// A place in world coordinates, and the axes that it looks along; w is where a hemisphere is seen.
struct Viewpoint {
    Vec3 position;
    Frame frame;
};

/// A place on a side of a patch, looking along its normal: a light sample on an area light. It is lifted off
/// the surface, and drawn in from the patch's edges by eight times as much, as RayCaster does (ray_caster.h,
/// for the reasons): so it does not see its own plane, nor past a wall that begins at an edge of the patch. A
/// place may be a corner of the patch.
Viewpoint viewpoint_on(const Patches& patches, std::uint32_t side, const math::Barycentric& place);

}  // namespace stilb::patches
