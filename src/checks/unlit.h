// Objects that no light reaches.
#pragma once

#include <vector>

#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::checks {

/// The objects that no light reaches, in the order of the scene; emitters are never among them. Light
/// particles are traced over some diffuse reflections; what they do not hit is looked at from where they
/// were. An object may be named wrongly only where almost no light gets to it.
std::vector<ObjectId> unlit_objects(const Scene& scene, const rays::RayCaster& caster);

}  // namespace stilb::checks
