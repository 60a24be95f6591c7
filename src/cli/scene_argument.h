// The scene that a command is given.
#pragma once

#include <string>
#include <vector>

#include "base/monitor.h"
#include "cli/command_line.h"
#include "cli/progress.h"
#include "io/scene/scene_file.h"

namespace stilb::cli {

/// Adds the flag that overrides keys of the scene file.
void add_overrides(Command& command, std::vector<std::string>& overrides);

/// Reads the scene file. Throws InputError as the reader does; where the file is evidently no scene, the
/// message also names the command that takes it.
io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides,
                         const Monitor& monitor);
/// The same, with progress on stderr where that takes long.
io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides,
                         ShowProgress show = ShowProgress::on_terminal);

}  // namespace stilb::cli
