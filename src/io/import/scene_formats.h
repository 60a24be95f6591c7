// Scenes in any format that can be read.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "io/scene/scene_file.h"
#include "io/text/file_kind.h"

namespace stilb::io {

/// Whether files of this kind are scenes of another format than TOML.
bool is_foreign_scene(FileKind kind);

/// Selects the reader by the file's content and, where that does not tell, by the extension of its name.
/// Throws InputError as the reader does, and where the file is no scene.
SceneFile read_scene_of_any_format(const std::filesystem::path& path,
                                   std::span<const std::string> overrides = {});

}  // namespace stilb::io
