// Cameras: the directions of positions on a picture.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "sensors/fields.h"

namespace stilb::sensors {

/// The projection of directions to a picture.
enum class Projection {
    perspective,  ///< onto a plane: straight lines stay straight
    fisheye,      ///< equiangular: the distance from the middle is proportional to the angle from the axis
    panorama,     ///< equirectangular: azimuth across, elevation upwards
};

inline constexpr std::array<std::string_view, 3> kProjectionNames{"perspective", "fisheye", "panorama"};
constexpr std::string_view name_of(Projection projection) {
    return kProjectionNames[static_cast<std::size_t>(projection)];
}

/// The filter that makes a pixel's value from the luminances around it.
enum class PixelFilter {
    box,       ///< their mean over the pixel
    gaussian,  ///< their mean about its middle, weighted by a Gaussian of half a pixel's standard deviation
};
inline constexpr std::array<std::string_view, 2> kPixelFilterNames{"box", "gaussian"};
constexpr std::string_view name_of(PixelFilter filter) {
    return kPixelFilterNames[static_cast<std::size_t>(filter)];
}

struct Camera {
    Vec3 position, target{1, 0, 0}, up{0, 0, 1};
    double fov_deg = 60;                  ///< from the left edge to the right one
    std::array<int, 2> resolution{1, 1};  ///< width and height in pixels
    Projection projection = Projection::perspective;
    PixelFilter filter = PixelFilter::box;

    static constexpr std::string_view kType = "camera";
    static constexpr Quantity kQuantity = kLuminance;
    static constexpr Noun kReadings{"pixel", "pixels"};
    /// Files of larger pictures could not be read back.
    static constexpr CountLimit kLimit{"[width, height]", 100'000, 64'000'000, "pixels", "in a picture"};
    static constexpr Range kAnyNumber{std::numeric_limits<double>::lowest(),
                                      std::numeric_limits<double>::max(), "a number"};
    static constexpr auto fields() {
        return std::tuple{
            PositionField{"position", &Camera::position, "of the camera"},
            TargetField{"target", &Camera::target, &Camera::position, "in the middle of the picture"},
            DirectionField{"up", &Camera::up, "upwards in the picture; by default [0, 0, 1]",
                           Presence::optional, false},
            Field{"fov", &Camera::fov_deg, kAnyNumber,
                  "from the left edge to the right one [degrees]; range and default go by the projection",
                  Presence::optional},
            CountsField{"resolution", &Camera::resolution, kLimit, "width and height in pixels"},
            ChoiceField{"projection", &Camera::projection, kProjectionNames,
                        "projection of directions; by default perspective"},
            ChoiceField{"filter", &Camera::filter, kPixelFilterNames,
                        "filter over the luminances around a pixel; by default box"}};
    }
    /// Sets the field of view where it is not given.
    std::optional<Fault> settle(const GivenKeys& given);
};

/// A camera with its axes. Positions are in pixels from the upper left corner of the picture, y downwards:
/// pixel (i, j) extends from (i, j) to (i + 1, j + 1).
class CameraView {
  public:
    /// Preconditions: `up` and the direction to the target are not 0 and not parallel.
    explicit CameraView(const Camera& camera);

    /// The unit viewing direction at a position; nothing outside of the camera's field (such as the
    /// circle of a fisheye).
    std::optional<Vec3> direction_at(double x, double y) const;
    const Vec3& position() const { return position_; }
    const Vec3& right() const { return right_; }
    const Vec3& up() const { return up_; }
    const Vec3& forward() const { return forward_; }

  private:
    Vec3 position_, right_, up_, forward_;  ///< right x up = -forward
    std::array<int, 2> resolution_;
    Projection projection_;
    double per_pixel_;  ///< at the middle: length on a plane at distance 1, or angle [rad]
};

/// The pixels outside of the camera's field, row by row from the top.
std::vector<bool> blind_pixels(const Camera& camera);

}  // namespace stilb::sensors

namespace stilb {
using sensors::Camera;
using sensors::PixelFilter;
using sensors::Projection;
}  // namespace stilb
