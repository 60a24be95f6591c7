// Pictures as PNG, to look at. The only file that sees libpng: Cairo, which draws everything else, cannot
// keep notes in a PNG.
#pragma once

#include <string>

#include "io/image/picture.h"
#include "io/image/tone_curve.h"

namespace stilb::io {

/// The file's content: 8-bit sRGB. Its texts are "Exposure" (per cd/m2), "Tone curve" and header_fields().
std::string to_png(const Picture& picture, const ToneCurve& curve);

}  // namespace stilb::io
