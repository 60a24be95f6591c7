// What estimators cannot make, said to the user rather than left out silently.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace stilb {

bool has_specular_surfaces(const Scene& scene);

/// A warning that begins with `what` where the scene has mirrors or glass, and point or photometry lights;
/// empty elsewhere.
std::vector<std::string> specular_warnings(const Scene& scene, std::string_view what);

}  // namespace stilb
