// Scenes of all formats that Stilb reads: its own (TOML) and those of other programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/monitor.h"
#include "geometry/transform.h"
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

/// From the coordinates of points and views that come with a scene to those of the scene. They differ where a
/// Radiance scene is turned or scaled by the overrides.
geometry::Transform placement_beside(const std::filesystem::path& path,
                                     std::span<const std::string> overrides);

}  // namespace stilb::io
