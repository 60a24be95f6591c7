// Points that stand for a light where highlights are drawn.
#pragma once

#include <vector>

#include "lights/light.h"
#include "scene/scene.h"

namespace stilb::walk {

struct HighlightPoint {
    Vec3 position;
    Vec3 normal;        ///< 0: it shines to all sides
    double weight = 0;  ///< share of the light; the weights of a light add up to 1
};

/// One point for point-like lights; 16 points of about equal area on lights with a surface; 64 far away
/// around the scene for light from infinity.
std::vector<HighlightPoint> highlight_points(const Scene& scene, const Light& light);

}  // namespace stilb::walk
