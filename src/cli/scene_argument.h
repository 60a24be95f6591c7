// The scene that a command is given.
#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"
#include "io/scene/scene_file.h"

namespace stilb::cli {

/// Adds the flag that overrides keys of the scene file.
void add_overrides(Command& command, std::vector<std::string>& overrides);

/// Reads the scene file. Throws InputError as the reader does; where the file is evidently no scene, the
/// message also names the command that takes it.
io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace stilb::cli
