// Materials of glTF as materials of Stilb.
#pragma once

#include <map>
#include <vector>

#include "io/import/gltf/gltf_textures.h"
#include "io/import/imported_scene.h"

namespace stilb::io::gltf {

/// The materials that surfaces have, by their index in the file; -1 is the default material. A material whose
/// surfaces are invisible has none.
std::map<int, MaterialId> add_materials(File& file, const std::vector<PlacedPrimitive>& primitives,
                                        ImportedScene& scene);

}  // namespace stilb::io::gltf
