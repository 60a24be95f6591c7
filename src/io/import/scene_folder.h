// A scene as a folder: scene.toml with the meshes, luminaires and pictures that it refers to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"

namespace stilb::io {

/// Writes a scene of any format to a folder, which is made where it does not exist. The scene in it measures
/// the same. Options of the run are left out. Returns the files, scene.toml first. Throws InputError where a
/// file cannot be written, where the folder has a scene.toml that Stilb has not written, and for contents
/// that only scenes in TOML can have (surfaces by harmonics, derived values ...).
std::vector<std::filesystem::path> write_scene_folder(const SceneFile& file,
                                                      const std::filesystem::path& folder);

}  // namespace stilb::io
