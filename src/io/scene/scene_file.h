// The scene file: TOML, the contract with users (docs/scene-format.md).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/toml.h"
#include "run/options.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::io {

struct SceneFile {
    Scene scene;
    std::vector<Sensor> sensors;
    RunOptions run;
    /// The scene file and all files that it refers to (none where it was read from memory).
    std::vector<std::filesystem::path> sources;
    /// What is odd but not wrong (degenerate triangles dropped, normals made unit, ...), for `info` and
    /// stderr.
    std::vector<std::string> warnings;
};

/// Throws InputError naming file, line, key, what was found and what is allowed.
SceneFile read_scene_file(const std::filesystem::path& path);

/// The reader itself; `directory` is where the scene's file paths start, `name` is used in messages.
SceneFile read_scene(std::string_view toml, const std::string& name, const std::filesystem::path& directory);
/// The same of a tree that was made in code: its lines are 0, and messages leave an empty name out.
SceneFile read_scene(const TomlMembers& members, const std::string& name,
                     const std::filesystem::path& directory);

}  // namespace stilb::io
