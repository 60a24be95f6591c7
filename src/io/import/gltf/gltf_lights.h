// Lights and cameras of glTF: KHR_lights_punctual and EXT_lights_ies.
#pragma once

#include <vector>

#include "io/import/gltf/gltf_nodes.h"
#include "io/import/imported_scene.h"

namespace stilb::io::gltf {

void add_lights(File& file, const std::vector<PlacedNode>& nodes, ImportedScene& scene);
void add_cameras(const File& file, const std::vector<PlacedNode>& nodes, ImportedScene& scene);

}  // namespace stilb::io::gltf
