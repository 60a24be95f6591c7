// Materials of glTF as materials of Stilb.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "io/import/gltf/gltf_textures.h"
#include "io/import/imported_scene.h"

namespace stilb::io::gltf {

struct SurfaceMaterial {
    MaterialId id;
    std::optional<UvTransform> texture = {};  ///< the place of the texture that its surfaces show
};

/// The materials that surfaces have, by their index in the file; -1 is the default material. A material whose
/// surfaces are invisible has none. `shows_textures`: of base colours; otherwise their means count.
std::map<int, SurfaceMaterial> add_materials(File& file, const std::vector<PlacedPrimitive>& primitives,
                                             bool shows_textures, ImportedScene& scene);

}  // namespace stilb::io::gltf
