// The scene file: TOML in the format of docs/scene-format.md.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.h"
#include "base/warning.h"
#include "io/scene/toml.h"
#include "run/options.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::io {

struct SceneFile {
    Scene scene;
    std::vector<Sensor> sensors;
    RunOptions run;
    /// The scene file and all files that it refers to (none for a scene read from memory).
    std::vector<std::filesystem::path> sources;
    /// Values that replaced those of the scene file (overrides.h).
    std::vector<std::string> overrides;
    /// Conventions by which a file of another program was read (units ...), a sentence each, for `info`.
    std::vector<std::string> notes = {};
    /// Unusual but valid contents (degenerate triangles dropped, normals normalised, ...), for `info` and
    /// stderr.
    std::vector<Warning> warnings;
    /// Contents of luminaire files that are parts of the scene's file, by NamedSolid::file: `import` writes
    /// them as files of their own.
    std::map<std::string, std::string> embedded_luminaires;
};

/// The warning of a scene without lamps.
inline constexpr std::string_view kNoLight = "no light: the scene is dark.";

/// Throws InputError with file, line, key, the value found and the allowed values, and Cancelled as the
/// monitor does, which takes the share that is read of mesh files.
SceneFile read_scene_file(const std::filesystem::path& path, std::span<const std::string> overrides = {},
                          const Monitor& monitor = Monitor::none());

/// The reader for content in memory; `directory` is the base of the scene's file paths, `name` is used in
/// messages.
SceneFile read_scene(std::string_view toml, const std::string& name, const std::filesystem::path& directory,
                     std::span<const std::string> overrides = {}, const Monitor& monitor = Monitor::none());
/// The same for a tree that was built in code: its lines are 0, and messages leave an empty name out. `file`:
/// what the scene has already; its parts can be referred to, but faces of its meshes not be picked as lamps.
SceneFile read_scene(const TomlMembers& members, const std::string& name,
                     const std::filesystem::path& directory, SceneFile file = {},
                     const Monitor& monitor = Monitor::none());

}  // namespace stilb::io
