#include "io/import/scene_formats.h"

#include <algorithm>
#include <array>

#include "io/import/gltf/gltf_scene.h"
#include "io/import/obj/obj_scene.h"
#include "io/import/radiance/radiance_scene_file.h"
#include "io/text/unread_bytes.h"

namespace stilb::io {
namespace {

using Overrides = std::span<const std::string>;

/// The formats of other programs.
struct SceneFormat {
    FileKind kind;
    SceneFile (*read)(const std::filesystem::path& path, Overrides overrides, const Monitor& monitor);
};
constexpr std::array kSceneFormats{
    SceneFormat{FileKind::gltf_scene, [](const std::filesystem::path& path, Overrides overrides,
                                         const Monitor&) { return read_gltf_scene(path, overrides); }},
    SceneFormat{FileKind::obj_mesh, read_obj_scene},
    SceneFormat{FileKind::radiance_scene,
                [](const std::filesystem::path& path, Overrides overrides, const Monitor&) {
                    return read_radiance_scene(path, overrides);
                }}};

auto format_of(FileKind kind) { return std::ranges::find(kSceneFormats, kind, &SceneFormat::kind); }

}  // namespace

bool is_scene(FileKind kind) { return may_be_scene_file(kind) || format_of(kind) != kSceneFormats.end(); }

SceneFile load_scene(const std::filesystem::path& path, std::span<const std::string> overrides,
                     const Monitor& monitor) {
    const auto format = format_of(kind_of_file(path));
    monitor.report(reading_stage(path), 0);
    return format == kSceneFormats.end() ? read_scene_file(path, overrides, monitor)
                                         : format->read(path, overrides, monitor);
}

geometry::Transform placement_beside(const std::filesystem::path& path,
                                     std::span<const std::string> overrides) {
    if (overrides.empty() || kind_of_file(path) != FileKind::radiance_scene) return {};
    return ImportSettings(overrides, path.string()).options().to_world(UpAxis::z);
}

}  // namespace stilb::io
