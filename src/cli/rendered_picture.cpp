#include "cli/rendered_picture.h"

namespace stilb::cli {

io::Picture picture_of(const Pixels& pixels, const Camera& camera, const io::PictureOrigin& origin) {
    io::Picture picture;
    picture.width = camera.resolution[0];
    picture.height = camera.resolution[1];
    picture.rgb_cd_m2 = pixels.rgb_cd_m2;
    picture.standard_error_cd_m2 = pixels.standard_error_cd_m2;
    picture.camera = camera;
    picture.origin = origin;
    return picture;
}

io::Picture picture_of(const RenderResult& result, const Camera& camera, io::PictureOrigin origin) {
    origin.paths = result.samples;
    origin.replicates = result.replicates;
    origin.elapsed_s = result.elapsed_s;
    if (result.patches) {
        origin.patches = result.patches->count;
        origin.patch_size_m = result.patches->size_m;
        origin.first_shot = name_of(result.patches->first_shot);
    }
    io::Picture picture = picture_of(result.pixels, camera, origin);
    picture.normals = result.normals;
    picture.depth_m = result.depth_m;
    return picture;
}

}  // namespace stilb::cli
