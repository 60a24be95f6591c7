// Scenes in Wavefront OBJ with materials in MTL files. docs/import.md lists what becomes of their contents.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "io/scene/scene_file.h"

namespace stilb::io {

/// Throws InputError with file and line.
SceneFile read_obj_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

/// Whether an OBJ file names a file with materials.
bool names_materials(const std::filesystem::path& path);

}  // namespace stilb::io
