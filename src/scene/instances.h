// When objects share a mesh.
#pragma once

#include "scene/scene.h"

namespace stilb::scene {

/// Whether `uses` objects with a mesh of so many triangles share it as instances. Rays take longer to enter
/// an instance than a copy, so that small meshes are copied.
bool are_instances(std::size_t triangles, std::size_t uses);

/// Gives a mesh of its own to an object that is an instance, so that it can be changed.
void make_own_mesh(Object& object);

}  // namespace stilb::scene
