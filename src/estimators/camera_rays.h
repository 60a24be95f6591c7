// The rays that pixels are measured along.
#pragma once

#include <optional>

#include "base/random.h"
#include "base/sample_stream.h"
#include "estimators/picture_estimator.h"

namespace stilb {

/// What of a pass's key the pixels' own numbers are derived by; other purposes take other numbers.
inline constexpr std::uint64_t kPixels = 1;

/// The numbers of the samples that a pass makes of single pixels. Sobol' points for the place in the pixel
/// and the first light and direction.
class PixelStreams {
  public:
    PixelStreams(const Camera& camera, const Pass& pass)
        : width_(static_cast<std::uint64_t>(camera.resolution[0])),
          key_(pass.key.derived(kPixels)),
          index_(pass.index) {}

    SampleStream at(int x, int y) const {
        constexpr unsigned sobol_dimensions = 8;
        const std::uint64_t pixel = static_cast<std::uint64_t>(y) * width_ + static_cast<std::uint64_t>(x);
        return SampleStream(key_.derived(pixel), index_, sobol_dimensions);
    }

  private:
    std::uint64_t width_;
    RandomKey key_;
    std::uint64_t index_;
};

/// The unit direction that a sample of pixel (x, y) looks along, drawn by the camera's filter; nothing beside
/// what the camera shows.
std::optional<Vec3> sample_pixel(const Camera& camera, const CameraView& view, int x, int y,
                                 SampleStream& stream);

}  // namespace stilb
