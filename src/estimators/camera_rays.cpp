#include "estimators/camera_rays.h"

#include <cmath>
#include <numbers>

namespace stilb {

std::optional<Vec3> sample_pixel(const Camera& camera, const CameraView& view, int x, int y,
                                 SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    if (camera.filter == PixelFilter::box) return view.direction_at(x + u1, y + u2);
    // [Box and Muller 1958]; 1 - u1 is never 0.
    constexpr double deviation = 0.5;
    const double radius = deviation * std::sqrt(-2 * std::log(1 - u1));
    const double angle = 2 * std::numbers::pi * u2;
    return view.direction_at(x + 0.5 + radius * std::cos(angle), y + 0.5 + radius * std::sin(angle));
}

}  // namespace stilb
