// Luminance pictures of a camera, with their origin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/rgb.h"
#include "run/result.h"
#include "sensors/camera.h"

namespace stilb::io {

/// The origin of a picture. Empty texts and zeros stand for unknown values.
struct PictureOrigin {
    std::string scene;       ///< the file, as the user named it
    std::string scene_hash;  ///< of the scene file and all files that it refers to
    std::string sensor;
    std::string method;
    std::string technique;  ///< as RunSummary's
    std::string command;    ///< the command line
    std::string version;    ///< of Stilb; empty where another program made the picture
    std::optional<std::uint64_t> seed;
    std::uint64_t paths = 0;
    int replicates = 0;
    double elapsed_s = 0;
    std::uint64_t patches = 0;  ///< that represent the surfaces
    double patch_size_m = 0;    ///< no edge is longer
    std::string first_shot;     ///< the variant that replaces small lights
    std::string scene_name;     ///< as the scene file gives it
    bool operator==(const PictureOrigin&) const = default;
};

/// A part of the light of a picture: of a lamp, of a group of lamps, or after so many reflections.
struct PictureLayer {
    std::string name;
    std::vector<std::array<float, 3>> rgb_cd_m2;
};

/// Pixels row by row from the top, from left to right. A channel has a value for each pixel; an optional
/// channel may be empty. NaN marks a pixel without a value.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::array<float, 3>> rgb_cd_m2;  ///< linear Rec. 709
    std::vector<float> standard_error_cd_m2;      ///< optional; of the luminance
    std::vector<std::array<float, 3>> normals;    ///< optional; unit vectors in the scene's coordinates
    std::vector<float> depth_m;                   ///< optional; distance from the camera
    std::optional<Camera> camera;                 ///< its resolution is the picture's
    PictureOrigin origin;
    std::vector<PictureLayer> layers{};  ///< optional; they add up to the whole

    std::size_t pixel_count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    double luminance_cd_m2(std::size_t pixel) const {
        const std::array<float, 3>& rgb = rgb_cd_m2[pixel];
        return Rgb{{rgb[0], rgb[1], rgb[2]}}.luminance();
    }
};

/// Whether readers accept a picture of this size: up to 100 million pixels (1.2 GB in memory), and 100 000
/// pixels on a side.
bool is_readable_size(long long width, long long height);
std::string too_large_message(long long width, long long height);

/// Throws std::invalid_argument where there are no pixels, or a channel has another size.
void require_consistency(const Picture& picture);

/// A picture that is not finished.
Picture picture_of(const Pixels& pixels, const Camera& camera, const PictureOrigin& origin);
/// A finished one, with normals and depth; how it went is added to the origin.
Picture picture_of(const RenderResult& result, const Camera& camera, PictureOrigin origin);

// The metadata of a picture file: named texts, the same in all formats.

struct HeaderField {
    std::string name;
    std::string text;        ///< one line
    bool is_number = false;  ///< for formats that have numbers
};

/// Origin (scene, sceneName, sceneHash, sensor, method, technique, seed, paths, replicates, elapsed_s,
/// patches, patchSize_m, firstShot, command, software) and view; unknown values are left out.
///
/// The view is in Radiance's words: VIEW = "-vtv -vp 0 0 1.5 -vd 1 0 0 -vu 0 0 1 -vh 60 -vv 36", with -vtv
/// for perspective and -vta for an (equiangular) fisheye. Radiance has no equirectangular type (its -vtc is a
/// perspective upwards), so a panorama has a field PANORAMA without type instead, which Radiance ignores.
std::vector<HeaderField> header_fields(const Picture& picture);

/// The view alone.
HeaderField view_field(const Camera& camera);

/// Reads the fields of header_fields(), with names in any case; other fields and values out of range are
/// ignored. Width and height must be set.
void read_header_field(Picture& picture, std::string_view name, std::string_view text);

}  // namespace stilb::io
