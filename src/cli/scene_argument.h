// The scene that a command is given.
#pragma once

#include <string>

#include "io/scene/scene_file.h"

namespace stilb::cli {

/// Reads the scene file. Throws InputError as the reader does; where the file is evidently no scene, the
/// message also names the command that takes it.
io::SceneFile read_scene(const std::string& path);

}  // namespace stilb::cli
