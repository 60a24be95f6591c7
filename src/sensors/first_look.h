// A first look at a scene that has no lamps or no cameras yet.
#pragma once

#include <vector>

#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::sensors {

/// A camera named "preview". It stands in a corner of the largest room, at the height of the eyes, and looks
/// through it; where there is no room, it looks at all of the scene from outside.
Sensor camera_for_first_look(const Scene& scene, const rays::RayCaster& caster);

/// Lights for a walk through a scene that has none: a bare bulb in each of the largest rooms, one outside,
/// where camera_for_first_look() would stand if there were no room, and an even sky. They are in two groups.
std::vector<Light> lights_for_first_look(const Scene& scene, const rays::RayCaster& caster);

/// The scene with one lamp only, a bare bulb at the camera, so that nothing that the camera sees is in
/// shadow.
Scene with_headlight(Scene scene, const Camera& camera);

}  // namespace stilb::sensors
