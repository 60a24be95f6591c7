// Path tracing of pictures: one path from the camera for each sample of a pixel, with next-event estimation
// (path_tracer.h). The naive twin of the other methods.
#include "estimators/path/picture_path.h"

#include "estimators/camera_paths.h"
#include "estimators/path/flattened_paths.h"

namespace stilb::estimators {
namespace {

class Paths final : public PicturePass {
  public:
    Paths(const PictureTracing& tracing, const transport::PathTracer& tracer, const Pass& pass)
        : tracing_(tracing), tracer_(tracer), pass_(pass) {}

    std::uint64_t sample(const PixelBlock& block, std::span<Rgb> pixels) const override {
        CameraPaths started = tracing_.start_paths(pixels_of(block), pass_);
        tracer_.trace(started.paths, rays::Coherence::coherent);
        return started.write_to(pixels);
    }

  private:
    const PictureTracing& tracing_;
    const transport::PathTracer& tracer_;
    Pass pass_;
};

class PathPicture final : public PictureEstimator {
  public:
    explicit PathPicture(const PictureInput& input)
        : tracing_(input), paths_(input.scene, input.caster, input.patches) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<Paths>(tracing_, paths_.tracer, pass);
    }
    std::vector<std::string> warnings() const override { return paths_.warnings(); }
    std::optional<PatchReport> patch_report() const override { return paths_.report(); }

  private:
    PictureTracing tracing_;
    FlattenedPaths paths_;
};

}  // namespace

std::unique_ptr<PictureEstimator> make_path_picture(const PictureInput& input) {
    return std::make_unique<PathPicture>(input);
}

}  // namespace stilb::estimators
