// What was rendered, as a picture to be written.
#pragma once

#include "io/image/picture.h"
#include "run/render.h"

namespace stilb {

/// Of a picture that is not finished.
Picture picture_of(const Pixels& pixels, const Camera& camera, const PictureOrigin& origin);
/// Of a finished one, with normals and depth; how it went is added to the origin.
Picture picture_of(const RenderResult& result, const Camera& camera, PictureOrigin origin);

}  // namespace stilb
