// Things that are small beside the scene, and near to where light is measured.
#pragma once

#include <span>

#include "scene/scene.h"

namespace stilb::scene {

/// Whether a measured point is near to something so small that rays are too coarse for it in a scene of this
/// size, such as the rim of a hole of a millimetre.
bool sees_fine_things(const Scene& scene, std::span<const Vec3> measured);

}  // namespace stilb::scene
