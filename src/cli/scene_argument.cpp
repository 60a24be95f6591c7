#include "cli/scene_argument.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/import/scene_formats.h"
#include "io/import/view_file.h"
#include "io/text/file_kind.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

/// The sentence that names the command for such a file, with a blank before it; empty where there is none.
std::string command_for(io::FileKind kind, const std::string& path) {
    const std::string picture = std::filesystem::path(path).filename().replace_extension(".png").string();
    switch (kind) {
        case io::FileKind::exr_picture:
        case io::FileKind::hdr_picture:
        case io::FileKind::results:
            return fmt::format(" Stilb draws it with: stilb falsecolor {} -o {}", path, picture);
        case io::FileKind::solution:
            return fmt::format(" Stilb does so with: stilb render --from {} -o {}", path, picture);
        case io::FileKind::obj_mesh:
        case io::FileKind::ply_mesh:
        case io::FileKind::ies_luminaire:
        case io::FileKind::eulumdat_luminaire:
            return fmt::format(" Stilb shows its contents with: stilb info {}", path);
        default:
            return "";
    }
}

}  // namespace

void add_overrides(Command& command, std::vector<std::string>& overrides) {
    command
        .add("--set", overrides,
             "Take this value instead of the scene file's, such as materials.wall.reflectance=0.4 (may be "
             "repeated)")
        .value_name("KEY=VALUE")
        .repeatable();
}

void add_views(Command& command, std::vector<std::string>& views) {
    command
        .add("--view", views,
             "A camera more, with the name of this file: a view file of Radiance (.vf), or a picture (.hdr, "
             ".exr) "
             "with its view and size (may be repeated)")
        .value_name("FILE")
        .repeatable();
}

io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides,
                         const Monitor& monitor) {
    const io::FileKind kind = io::kind_of_file(path);
    if (!io::is_scene(kind)) throw InputError(io::not_a_scene(kind) + command_for(kind, path), {path});
    return io::load_scene(path, overrides, monitor);
}

io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides,
                         ShowProgress show) {
    const LoadingProgress progress(show);
    return read_scene(path, overrides, progress.monitor());
}

io::SceneFile read_scene(const std::string& path, const std::vector<std::string>& overrides,
                         const std::vector<std::string>& views, ShowProgress show) {
    io::SceneFile file = read_scene(path, overrides, show);
    if (views.empty()) return file;
    const geometry::Transform placement = io::placement_beside(path, overrides);
    for (const std::string& view : views) io::add_view(view, placement, file);
    return file;
}

}  // namespace stilb::cli
