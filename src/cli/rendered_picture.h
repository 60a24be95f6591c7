// Rendered results as pictures to be written.
#pragma once

#include "io/image/picture.h"
#include "run/result.h"

namespace stilb::cli {

/// The picture of an unfinished rendering.
io::Picture picture_of(const Pixels& pixels, const Camera& camera, const io::PictureOrigin& origin);
/// The finished picture with normals and depth. The run's method, samples and time are added to the origin.
io::Picture picture_of(const RenderResult& result, const Camera& camera, io::PictureOrigin origin);

}  // namespace stilb::cli
