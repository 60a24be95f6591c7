#include "io/import/scene_formats.h"

#include <algorithm>
#include <array>

#include "io/import/gltf/gltf_scene.h"
#include "io/import/obj/obj_scene.h"

namespace stilb::io {
namespace {

struct SceneFormat {
    FileKind kind;
    SceneFile (*read)(const std::filesystem::path& path, std::span<const std::string> overrides);
};
constexpr std::array kSceneFormats{SceneFormat{FileKind::gltf_scene, read_gltf_scene},
                                   SceneFormat{FileKind::obj_mesh, read_obj_scene}};

}  // namespace

bool is_foreign_scene(FileKind kind) {
    return std::ranges::find(kSceneFormats, kind, &SceneFormat::kind) != kSceneFormats.end();
}

SceneFile read_scene_of_any_format(const std::filesystem::path& path,
                                   std::span<const std::string> overrides) {
    const auto format = std::ranges::find(kSceneFormats, kind_of_file(path), &SceneFormat::kind);
    return format == kSceneFormats.end() ? read_scene_file(path, overrides) : format->read(path, overrides);
}

}  // namespace stilb::io
