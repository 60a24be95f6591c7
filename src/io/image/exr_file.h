// OpenEXR pictures. The only file that sees OpenEXR.
#pragma once

#include <string>
#include <string_view>

#include "io/image/picture.h"

namespace stilb::io {

/// The file's content, 32-bit floats without loss: channels R, G, B and Y (luminance) in cd/m2, where the
/// picture has them SE.Y (standard error of Y), N.X, N.Y, N.Z (normals) and Z (depth [m], as OpenEXR calls
/// it). The header has whiteLuminance 1 (so values are cd/m2), Rec. 709 chromaticities, and header_fields()
/// as texts.
std::string to_exr(const Picture& picture);

/// Reads R, G, B, or Y alone as grey, of any type, and the optional channels that are there. Values are
/// multiplied by whiteLuminance and converted from other chromaticities where the header has them. `name` is
/// used in messages. Throws InputError for what is no such picture, damaged or truncated.
Picture read_exr(std::string_view content, const std::string& name);

}  // namespace stilb::io
