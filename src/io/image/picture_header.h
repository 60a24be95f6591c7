// What a picture file says about its picture besides the pixels: named texts, the same in all formats.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/image/picture.h"

namespace stilb::io {

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
