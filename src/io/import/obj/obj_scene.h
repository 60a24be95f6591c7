// Scenes in Wavefront OBJ with materials in MTL files. docs/import.md lists what becomes of their contents.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/monitor.h"
#include "io/scene/scene_file.h"

namespace stilb::io {

/// Throws InputError with file and line, and Cancelled as the monitor does.
SceneFile read_obj_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {},
                         const Monitor& monitor = Monitor::none());

/// Whether an OBJ file names a file with materials.
bool names_materials(const std::filesystem::path& path);

}  // namespace stilb::io
