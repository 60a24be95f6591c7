// Luminance pictures: what a camera measured, with where it comes from.
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

/// How a picture came about. Empty texts and zeros are unknown.
struct PictureOrigin {
    std::string scene;       ///< the file, as the user named it
    std::string scene_hash;  ///< of what the scene consists of
    std::string sensor;
    std::string method;
    std::string command;  ///< the command line
    std::string version;  ///< of Stilb; empty where another program made the picture
    std::optional<std::uint64_t> seed;
    std::uint64_t paths = 0;
    int replicates = 0;
    double elapsed_s = 0;
    std::uint64_t patches = 0;  ///< that stand for the surfaces
    double patch_size_m = 0;    ///< no edge is longer
    std::string first_shot;     ///< which one stands for small lights
    bool operator==(const PictureOrigin&) const = default;
};

/// Pixels go row by row from the top, from left to right. A channel has a value for each pixel, or none at
/// all where it is optional. NaN says that a pixel has no value.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::array<float, 3>> rgb_cd_m2;  ///< linear Rec. 709
    std::vector<float> standard_error_cd_m2;      ///< optional; of the luminance
    std::vector<std::array<float, 3>> normals;    ///< optional; unit vectors in the scene's coordinates
    std::vector<float> depth_m;                   ///< optional; distance from the camera
    std::optional<Camera> camera;                 ///< its resolution is the picture's
    PictureOrigin origin;

    std::size_t pixel_count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    double luminance_cd_m2(std::size_t pixel) const {
        const std::array<float, 3>& rgb = rgb_cd_m2[pixel];
        return Rgb{{rgb[0], rgb[1], rgb[2]}}.luminance();
    }
};

/// Whether a reader takes a picture of that size: up to 100 million pixels (1.2 GB in memory), and 100 000
/// pixels on a side.
bool is_readable_size(long long width, long long height);
std::string too_large_message(long long width, long long height);

/// Throws std::invalid_argument where there are no pixels or a channel's size is not theirs.
void require_consistency(const Picture& picture);

/// A picture that is not finished.
Picture picture_of(const Pixels& pixels, const Camera& camera, const PictureOrigin& origin);
/// A finished one, with normals and depth; how it went is added to the origin.
Picture picture_of(const RenderResult& result, const Camera& camera, PictureOrigin origin);

// What a picture file says about its picture besides the pixels: named texts, the same in all formats.

struct HeaderField {
    std::string name;
    std::string text;  ///< one line
};

/// Origin (scene, sceneHash, sensor, method, seed, paths, replicates, elapsed_s, patches, patchSize_m,
/// firstShot, command, software) and view; what is unknown is left out.
///
/// The view is in Radiance's words: VIEW = "-vtv -vp 0 0 1.5 -vd 1 0 0 -vu 0 0 1 -vh 60 -vv 36", with -vtv
/// for perspective and -vta for an (equiangular) fisheye. Radiance has no equirectangular type (its -vtc is a
/// perspective upwards), so a panorama has a field PANORAMA without type instead, which Radiance passes over.
std::vector<HeaderField> header_fields(const Picture& picture);

/// Takes in what header_fields() gave, names in any case; whatever else or out of range is passed over. Width
/// and height must be known.
void read_header_field(Picture& picture, std::string_view name, std::string_view text);

}  // namespace stilb::io
