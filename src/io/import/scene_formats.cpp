#include "io/import/scene_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/import/radiance/radiance_scene_file.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

/// The formats of other programs.
struct SceneFormat {
    FileKind kind;
    SceneFile (*read)(const std::filesystem::path& path);
};
constexpr std::array kSceneFormats{SceneFormat{
    FileKind::radiance_scene, [](const std::filesystem::path& path) { return read_radiance_scene(path); }}};

auto format_of(FileKind kind) { return std::ranges::find(kSceneFormats, kind, &SceneFormat::kind); }

}  // namespace

bool is_scene(FileKind kind) { return may_be_scene_file(kind) || format_of(kind) != kSceneFormats.end(); }

SceneFile load_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
    const FileKind kind = kind_of_file(path);
    const auto format = format_of(kind);
    if (format == kSceneFormats.end()) return read_scene_file(path, overrides);
    if (!overrides.empty()) {
        throw InputError(
            fmt::format(
                "this value cannot be set, because '{}' is {}: only scene files (TOML) have such keys. "
                "Import the scene as a scene file first, or change its own file.",
                path.string(), name_of(kind)),
            {overrides.front()});
    }
    return format->read(path);
}

}  // namespace stilb::io
