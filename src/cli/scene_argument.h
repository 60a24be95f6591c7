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

/// Adds the flag that takes views of Radiance as cameras.
void add_views(Command& command, std::vector<std::string>& views);

/// Reads the scene file. Throws InputError as the reader does; where the file is evidently no scene, the
/// message also names the command that takes it.
io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides,
                         const Monitor& monitor);
/// The same, with progress on stderr where that takes long.
io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides,
                         ShowProgress show = ShowProgress::on_terminal);
/// The same, with the views of these files as more cameras, the last of its sensors.
io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides,
                         const std::vector<std::string>& views, ShowProgress show);

}  // namespace stilb::cli
