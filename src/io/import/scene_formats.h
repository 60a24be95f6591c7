// Scenes of all formats that Stilb reads: its own (TOML) and those of other programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/monitor.h"
#include "io/scene/scene_file.h"
#include "io/text/file_kind.h"

namespace stilb::io {

/// Whether a file of this kind is a scene that load_scene() reads.
bool is_scene(FileKind kind);

/// Reads a scene by its kind: the file's content or, where that does not tell, the extension of its name.
/// `overrides`: of formats other than TOML see ImportSettings. Throws InputError with file and line, and
/// Cancelled as the monitor does.
SceneFile load_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {},
                     const Monitor& monitor = Monitor::none());

}  // namespace stilb::io
