// Points that stand for a light where highlights are drawn.
#pragma once

#include <vector>

#include "lights/emitter_elements.h"
#include "lights/light.h"
#include "scene/scene.h"

namespace stilb::walk {

/// One point for point-like lights; 16 points of about equal area on lights with a surface; 64 far away
/// around the scene for light from infinity. In the open where it shines to all sides. The weights, shares of
/// the light, add up to 1.
std::vector<lights::EmitterPoint> highlight_points(const Scene& scene, const Light& light);

}  // namespace stilb::walk
