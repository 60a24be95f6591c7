// Radiance scenes (.rad) as scenes of Stilb. What maps to what: docs/radiance.md.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/import/radiance/description.h"
#include "io/scene/scene_file.h"

namespace stilb::io {

/// Reads the file and all that it includes; no program is run. Sensors are those of the overrides
/// (ImportSettings). Throws InputError with file and line.
SceneFile read_radiance_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});
/// The same for content in memory; `folder` is the base of its file names, `name` is used in messages.
SceneFile read_radiance_scene(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder,
                              std::span<const std::string> overrides = {},
                              const radiance::Limits& limits = {});

}  // namespace stilb::io
