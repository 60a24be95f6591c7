// Scenes of all formats that Stilb reads: its own (TOML) and those of other programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "io/scene/scene_file.h"
#include "io/text/file_kind.h"

namespace stilb::io {

/// Whether a file of this kind is a scene that load_scene() reads.
bool is_scene(FileKind kind);

/// Reads a scene by its kind. `overrides` are for scene files of Stilb alone. Throws InputError with file and
/// line.
SceneFile load_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

}  // namespace stilb::io
