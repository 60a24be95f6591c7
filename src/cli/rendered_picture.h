// What was rendered, as a picture to be written.
#pragma once

#include "io/image/picture.h"
#include "run/result.h"

namespace stilb::cli {

/// Of a picture that is not finished.
io::Picture picture_of(const Pixels& pixels, const Camera& camera, const io::PictureOrigin& origin);
/// Of a finished one, with normals and depth; how it went is added to the origin.
io::Picture picture_of(const RenderResult& result, const Camera& camera, io::PictureOrigin origin);

}  // namespace stilb::cli
