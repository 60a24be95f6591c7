// Objects by harmonics, truncated to the degree that their sensors can resolve.
//
// A surface of degree d instead of L lies within max |R - R_d| of the full one, for which there is a safe
// bound (range_of()). The degree is the lowest for which that is half a footprint at most, at the least
// distance from any sensor to the object: the footprint of a camera is a pixel in the middle of its picture,
// that of other sensors 1 mrad. So outlines, and shadows on the object itself, move by at most half a
// footprint. Normals are those of the smoother surface; mirror images and lamps close to the object may show
// larger differences.
#pragma once

#include <span>
#include <vector>

#include "run/result.h"
#include "scene/scene.h"

namespace stilb::run {

struct DetailedScene {
    Scene scene;
    std::vector<LevelOfDetail> levels;  ///< of the objects that request it
};

bool has_levels_of_detail(const Scene& scene);
DetailedScene with_levels_of_detail(Scene scene, std::span<const Sensor> sensors);

}  // namespace stilb::run
