// Path tracing of pictures: one path from the camera for each sample of a pixel, with next-event estimation
// (path_tracer.h). The naive twin of the other methods.
#include "estimators/picture_path.h"

#include "estimators/camera_rays.h"
#include "estimators/limits.h"
#include "estimators/path_tracer.h"

namespace stilb {
namespace {

class PathPicture final : public PictureEstimator {
  public:
    explicit PathPicture(const PictureInput& input)
        : scene_(input.scene),
          caster_(input.caster),
          camera_(input.camera),
          view_(camera_),
          max_reflections_(input.max_reflections),
          lights_(scene_, caster_),
          tracer_(scene_, caster_, lights_) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<Paths>(*this, pass);
    }
    std::vector<std::string> warnings() const override { return path_warnings(scene_); }

  private:
    class Paths final : public PicturePass {
      public:
        Paths(const PathPicture& picture, const Pass& pass)
            : picture_(picture), streams_(picture.camera_, pass) {}

        std::uint64_t sample(const PixelBlock& block, std::span<Spectrum> pixels) const override {
            std::uint64_t invalid = 0;
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                const int x = block.left + static_cast<int>(i) % block.width;
                const int y = block.top + static_cast<int>(i) / block.width;
                pixels[i] = picture_.sample_luminance(x, y, streams_.at(x, y));
                if (pixels[i].is_finite()) continue;
                pixels[i] = {};
                ++invalid;
            }
            return invalid;
        }

      private:
        const PathPicture& picture_;
        PixelStreams streams_;
    };

    Spectrum sample_luminance(int x, int y, SampleStream stream) const {
        const auto direction = sample_pixel(camera_, view_, x, y, stream);
        if (!direction) return {};
        const auto hit = caster_.closest(view_.position(), *direction);
        return hit ? tracer_.luminance(*hit, *direction, max_reflections_, stream) : Spectrum{};
    }

    const Scene& scene_;
    const RayCaster& caster_;
    Camera camera_;
    CameraView view_;
    int max_reflections_;
    LightSampler lights_;
    PathTracer tracer_;
};

}  // namespace

std::unique_ptr<PictureEstimator> make_path_picture(const PictureInput& input) {
    return std::make_unique<PathPicture>(input);
}

}  // namespace stilb
