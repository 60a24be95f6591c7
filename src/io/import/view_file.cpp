#include "io/import/view_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/image/picture_file.h"
#include "io/image/radiance_view.h"
#include "io/import/imported_scene.h"
#include "io/text/file_kind.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

/// The options of a view on a line of a view file; empty where the line is about something else.
std::string_view view_options(std::string_view line) {
    constexpr std::array<std::string_view, 5> programs{"rvu", "rpict", "rview", "rpiece", "pinterp"};
    constexpr std::array<std::string_view, 2> keys{"VIEW=", "view="};
    line = trimmed(line);
    if (line.starts_with("-v")) return line;
    for (const std::string_view key : keys) {
        if (line.starts_with(key)) return line.substr(key.size());
    }
    const std::string_view program = next_word(line);
    const std::string_view name = program.substr(program.find_last_of('/') + 1);
    return std::ranges::find(programs, name) == programs.end() ? std::string_view() : line;
}

/// Whole pixels that fill a box as far as the shape of the picture allows.
std::array<int, 2> pixels_for(const RadianceView& view) {
    constexpr int usual = 1280;
    const int width = view.width.value_or(view.height.value_or(usual));
    const int height = view.height.value_or(width);
    const double aspect = view.aspect();
    const double across = std::min<double>(width, height / aspect);
    const auto pixels = [](double length) { return std::max(1, static_cast<int>(std::lround(length))); };
    return {pixels(across), pixels(across * aspect)};
}

/// Replaces what a camera cannot have, with a warning.
void make_possible(RadianceView& view, std::vector<std::string>& warnings) {
    if (view.type == 'h' || view.type == 's') {
        warnings.push_back(
            fmt::format("the fisheye -vt{} is not supported; an angular one (-vta) of the same angles stands "
                        "for it. The same "
                        "is seen, at other places of the picture.",
                        view.type));
        view.type = 'a';
    }
    if (view.shift != 0 || view.lift != 0)
        warnings.emplace_back("the shift (-vs) and the lift (-vl) of the picture off its axis are left out.");
    if (view.fore_m != 0 || view.aft_m != 0)
        warnings.emplace_back(
            "the clipping planes (-vo, -va) are left out: surfaces at all distances are seen.");
}

}  // namespace

ViewFile read_view_file(std::string_view content, const std::string& name) {
    RadianceView view;
    SourceLocation where{name};
    bool is_found = false;
    try {
        for (TextLines lines(content); lines.next();) {
            where.line = lines.number();
            is_found = view.read(view_options(lines.line())) || is_found;
        }
        where.line = 0;
        if (!is_found)
            throw InputError(
                "there is no view. Needed: a line such as rvu -vtv -vp 1 1 1.6 -vd 1 1 0 -vu 0 0 1 -vh 60 "
                "-vv 40.");
        ViewFile file;
        make_possible(view, file.warnings);
        const std::optional<Camera> camera = view.camera();
        if (!camera) {
            throw InputError(
                fmt::format("a view of type -vt{} is not supported. Allowed: -vtv (perspective) and "
                            "-vta (angular fisheye).",
                            view.type));
        }
        file.camera = *camera;
        file.camera.resolution = pixels_for(view);
        for (std::string& warning : file.warnings) warning = InputError(warning, {name}).what();
        return file;
    } catch (const InputError& error) {
        throw InputError(error.what(), where);
    }
}

ViewFile read_view_file(const std::filesystem::path& path) {
    if (!is_luminance_picture(kind_of_file(path))) return read_view_file(read_text_file(path), path.string());
    const Picture picture = read_picture(path);
    if (!picture.camera)
        throw InputError("the picture states no view that a camera can have.", {path.string()});
    return {*picture.camera, {}, !picture.origin.version.empty()};
}

std::string add_view(const std::filesystem::path& path, const geometry::Transform& placement,
                     SceneFile& file) {
    ViewFile view = read_view_file(path);
    if (!view.is_of_stilb && placement != geometry::Transform{}) {
        Camera& camera = view.camera;
        const Vec3 direction = camera.target - camera.position;
        camera.position = placement.point(camera.position);
        camera.target = camera.position + placement.direction(direction);
        camera.up = normalized(placement.direction(camera.up));
    }
    UniqueNames names;
    for (const Sensor& sensor : file.sensors) names.make(sensor.name, "");
    std::string name = names.make(path.stem().string(), "view");
    file.sensors.push_back({name, view.camera});
    file.sources.push_back(path);
    std::ranges::move(view.warnings, std::back_inserter(file.warnings));
    return name;
}

}  // namespace stilb::io
