// Surfaces that were probably meant to be closed.
#pragma once

#include <string>
#include <vector>

#include "geometry/connected_components.h"
#include "scene/scene.h"

namespace stilb::checks {

/// A sentence for each object with shells that are open but nearly enclose a space: light goes through their
/// holes. And one for emitters whose triangles do not all face the same side. `shells` are those of every
/// object.
std::vector<std::string> hole_warnings(const Scene& scene,
                                       const std::vector<geometry::ConnectedComponents>& shells);

}  // namespace stilb::checks
