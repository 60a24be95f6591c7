
#include "io/image/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "io/image/radiance_view.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

constexpr long long kMostPixels = 100'000'000;
constexpr long long kLongestSide = 100'000;

}  // namespace

bool is_readable_size(long long width, long long height) {
    return width <= kLongestSide && height <= kLongestSide && width * height <= kMostPixels;
}

std::string too_large_message(long long width, long long height) {
    return fmt::format("{} x {} pixels are too many. At most {} can be read, and {} on a side.", width,
                       height, kMostPixels, kLongestSide);
}

void require_consistency(const Picture& picture) {
    const std::size_t count = picture.pixel_count();
    const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
    const bool is_consistent = picture.width > 0 && picture.height > 0 && picture.rgb_cd_m2.size() == count &&
                               fits(picture.standard_error_cd_m2.size()) && fits(picture.normals.size()) &&
                               fits(picture.depth_m.size());
    if (!is_consistent) throw std::invalid_argument("a picture whose size and channels differ");
}

namespace {

constexpr std::string_view kSoftware = "Stilb ";

/// The full angle of view: up to 180 degrees for a perspective, else up to 360.
double vertical_fov_deg(const Camera& camera) {
    const double aspect = double(camera.resolution[1]) / camera.resolution[0];
    if (camera.projection != Projection::perspective) return camera.fov_deg * aspect;
    constexpr double kDegree = std::numbers::pi / 180;
    return 2 * std::atan(aspect * std::tan(camera.fov_deg / 2 * kDegree)) / kDegree;
}

std::string text_of(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

}  // namespace

HeaderField view_field(const Camera& camera) {
    const std::string view = fmt::format("-vp {} -vd {} -vu {} -vh {} -vv {}", text_of(camera.position),
                                         text_of(camera.target - camera.position), text_of(camera.up),
                                         camera.fov_deg, vertical_fov_deg(camera));
    switch (camera.projection) {
        case Projection::perspective:
            return {"VIEW", "-vtv " + view};
        case Projection::fisheye:
            return {"VIEW", "-vta " + view};
        case Projection::panorama:
            break;
    }
    return {"PANORAMA", view};
}

namespace {

/// Nothing where the view has no equal.
std::optional<Camera> read_view(std::string_view words, Projection projection) {
    RadianceView view;
    try {
        if (projection != Projection::perspective) view.type = 'a';
        view.read(words);
        if (view.shift != 0 || view.lift != 0) return std::nullopt;
        std::optional<Camera> camera = view.camera();
        if (camera && projection == Projection::panorama) camera->projection = projection;
        return camera;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

bool is_same_name(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

std::string on_one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text;
}

std::uint64_t whole_number(std::string_view text, std::uint64_t most = ~0ull) {
    return std::min(static_cast<std::uint64_t>(std::max(parse_integer(text).value_or(0), 0ll)), most);
}

void read_camera(Picture& picture, std::string_view text, Projection projection) {
    picture.camera = read_view(text, projection);
    if (picture.camera) picture.camera->resolution = {picture.width, picture.height};
}

}  // namespace

std::vector<HeaderField> header_fields(const Picture& picture) {
    const PictureOrigin& origin = picture.origin;
    std::vector<HeaderField> fields;
    const auto add = [&](std::string name, std::string text) {
        if (!text.empty()) fields.push_back({std::move(name), on_one_line(std::move(text))});
    };
    const auto add_number = [&](std::string name, std::string text) {
        fields.push_back({std::move(name), std::move(text), true});
    };
    if (!origin.version.empty()) add("software", std::string(kSoftware) + origin.version);
    add("command", origin.command);
    add("scene", origin.scene);
    add("sceneName", origin.scene_name);
    add("sceneHash", origin.scene_hash);
    add("sensor", origin.sensor);
    add("method", origin.method);
    add("technique", origin.technique);
    if (origin.seed) add_number("seed", fmt::to_string(*origin.seed));
    if (origin.paths > 0) add_number("paths", fmt::to_string(origin.paths));
    if (origin.replicates > 0) add_number("replicates", fmt::to_string(origin.replicates));
    if (origin.elapsed_s > 0) add_number("elapsed_s", fmt::format("{:.3f}", origin.elapsed_s));
    if (origin.patches > 0) add_number("patches", fmt::to_string(origin.patches));
    if (origin.patch_size_m > 0) add_number("patchSize_m", fmt::to_string(origin.patch_size_m));
    add("firstShot", origin.first_shot);
    if (picture.camera) fields.push_back(view_field(*picture.camera));
    return fields;
}

void read_header_field(Picture& picture, std::string_view name, std::string_view value) {
    const std::string text = printable(value);
    PictureOrigin& origin = picture.origin;
    const auto is = [&](std::string_view wanted) { return is_same_name(name, wanted); };
    if (is("software") && text.starts_with(kSoftware)) origin.version = text.substr(kSoftware.size());
    if (is("command")) origin.command = text;
    if (is("scene")) origin.scene = text;
    if (is("sceneName")) origin.scene_name = text;
    if (is("sceneHash")) origin.scene_hash = text;
    if (is("sensor")) origin.sensor = text;
    if (is("method")) origin.method = text;
    if (is("technique")) origin.technique = text;
    if (is("seed")) origin.seed = whole_number(text);
    if (is("paths")) origin.paths = whole_number(text);
    if (is("replicates")) origin.replicates = static_cast<int>(whole_number(text, 1'000'000));
    if (is("elapsed_s")) origin.elapsed_s = std::max(parse_number(text).value_or(0), 0.0);
    if (is("patches")) origin.patches = whole_number(text);
    if (is("patchSize_m")) origin.patch_size_m = std::max(parse_number(text).value_or(0), 0.0);
    if (is("firstShot")) origin.first_shot = text;
    if (is("VIEW")) read_camera(picture, text, Projection::perspective);
    if (is("PANORAMA")) read_camera(picture, text, Projection::panorama);
}

Picture picture_of(const Pixels& pixels, const Camera& camera, const PictureOrigin& origin) {
    Picture picture;
    picture.width = camera.resolution[0];
    picture.height = camera.resolution[1];
    picture.rgb_cd_m2 = pixels.rgb_cd_m2;
    picture.standard_error_cd_m2 = pixels.standard_error_cd_m2;
    picture.camera = camera;
    picture.origin = origin;
    return picture;
}

Picture picture_of(const RenderResult& result, const Camera& camera, PictureOrigin origin) {
    origin.technique = result.technique;
    origin.paths = result.samples;
    origin.replicates = result.replicates;
    origin.elapsed_s = result.elapsed_s;
    if (result.patches) {
        origin.patches = result.patches->count;
        origin.patch_size_m = result.patches->size_m;
        origin.first_shot = name_of(result.patches->first_shot);
    }
    Picture picture = picture_of(result.pixels, camera, origin);
    for (std::size_t layer = 0; layer < result.layers.size(); ++layer)
        picture.layers.push_back({result.layers[layer], result.pixels.layers_cd_m2[layer]});
    picture.normals = result.normals;
    picture.depth_m = result.depth_m;
    return picture;
}

}  // namespace stilb::io
