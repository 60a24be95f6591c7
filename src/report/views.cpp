// The pictures of a report.
#include "base/version.h"
#include "io/image/picture_file.h"
#include "report/report.h"

namespace stilb::report {

View make_view(const RenderResult& result, const Sensor& camera, const Scene& scene,
               const scene::WhiteRange& whites) {
    io::PictureOrigin origin;
    origin.scene_name = scene.name;
    origin.sensor = camera.name;
    origin.version = program_version();
    const io::Picture picture = io::picture_of(result.pixels, *camera.camera(), origin);
    const io::ToneCurve curve = io::tone_curve_for(picture, {std::nullopt, whites});
    return {camera.name,
            picture.width,
            picture.height,
            curve.exposure(),
            curve.white_k(),
            io::to_png(picture, curve),
            result.mean_luminance_cd_m2,
            result.mean_standard_error_cd_m2,
            result};
}

}  // namespace stilb::report
