// The rays that pixels are measured along.
#pragma once

#include <optional>

#include "base/random.h"
#include "base/sample_stream.h"
#include "estimators/picture_estimator.h"

namespace stilb {

/// What of a pass's key the pixels' own numbers are derived by; other purposes take other numbers.
inline constexpr std::uint64_t kPixels = 1;

/// The numbers of one sample of one pixel.
inline SampleStream pixel_stream(const Camera& camera, const Pass& pass, int x, int y) {
    const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(camera.resolution[0]) +
                       static_cast<std::uint64_t>(x);
    return SampleStream(pass.key.derived(kPixels).derived(pixel), pass.index);
}

/// The unit direction that a sample of pixel (x, y) looks along, drawn by the camera's filter; nothing beside
/// what the camera shows.
std::optional<Vec3> sample_pixel(const Camera& camera, const CameraView& view, int x, int y,
                                 SampleStream& stream);

}  // namespace stilb
