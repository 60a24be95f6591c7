// Bodies of glass: which medium lies on each side of their surfaces.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace stilb::scene {

/// Prepares the surfaces of glass for light, which knows a surface's two sides only:
/// - Fronts of closed bodies are turned outwards, those of their cavities inwards.
/// - A body inside of another one of glass gets a material that knows the medium around it.
/// - Faces that close no body become thin sheets.
/// Returns a sentence for objects whose glass is not closed, or is only a part of a closed surface, and for
/// bodies that cut each other. Lamps and objects that lamps were cut out of stay as they are.
std::vector<std::string> settle_glass(Scene& scene);

}  // namespace stilb::scene
