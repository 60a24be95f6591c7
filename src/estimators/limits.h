// What estimators cannot make, said to the user rather than left out silently.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace stilb {

bool has_specular_surfaces(const Scene& scene);

/// Warnings of what path tracing and local estimation leave out, where the scene has mirrors or glass, and
/// point or photometry lights; empty elsewhere.
std::vector<std::string> path_warnings(const Scene& scene);
std::vector<std::string> local_warnings(const Scene& scene);

}  // namespace stilb
