// Scenes in glTF 2.0 (.gltf and .glb). docs/gltf.md lists what becomes of its contents.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/import/import_settings.h"
#include "io/scene/scene_file.h"

namespace stilb::io {

/// Throws InputError with the part of the file that is wrong, such as accessors[3].
SceneFile read_gltf_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

/// The reader for content in memory. Files that the content refers to are read from the folder of `path`.
SceneFile read_gltf_scene(std::string_view content, const std::filesystem::path& path,
                          const ImportSettings& settings);

}  // namespace stilb::io
