#include "sensors/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stilb::sensors {
namespace {

/// Returns false also where rounding alone moves a position from the edge to the outside.
bool is_beyond(double angle, double limit) {
    constexpr double rounding = 1e-12;
    return std::abs(angle) > limit * (1 + rounding);
}

double per_pixel(const Camera& camera) {
    const double fov_rad = camera.fov_deg * kPi / 180;
    const double width = camera.projection == Projection::perspective ? 2 * std::tan(fov_rad / 2) : fov_rad;
    return width / camera.resolution[0];
}

struct FieldOfView {
    Range range;
    double default_deg = 0;
};

FieldOfView field_of_view(Projection projection) {
    switch (projection) {
        case Projection::perspective:
            return {{0.001, 179.9, "an angle above 0 and below 180 degrees (from 0.001 to 179.9)"}, 60};
        case Projection::fisheye:
            return {{0.001, 360, "an angle above 0 (from 0.001 to 360 degrees)"}, 180};
        case Projection::panorama:
            return {{0.001, 360, "an angle above 0 (from 0.001 to 360 degrees)"}, 360};
    }
    return {};
}

}  // namespace

std::optional<Fault> Camera::settle(const GivenKeys& given) {
    constexpr double least = 1e-6;  // sine of the angle between up and the view
    if (length(cross(normalized(target - position), up)) < least) {
        if (given.has("up"))
            return Fault{
                "up",
                "is parallel to the direction from position to target, so the picture has no upward side. "
                "Allowed: any other direction."};
        return Fault{"target",
                     "lies straight above or below the position, so the picture has no upward side. "
                     "Allowed: any other point, or another \"up\" than [0, 0, 1]."};
    }
    const FieldOfView view = field_of_view(projection);
    if (!given.has("fov")) fov_deg = view.default_deg;
    if (view.range.contains(fov_deg)) return std::nullopt;
    return Fault{"fov", fmt::format("{} is not allowed. Allowed: {}.", fov_deg, view.range.allowed)};
}

CameraView::CameraView(const Camera& camera)
    : position_(camera.position),
      forward_(normalized(camera.target - camera.position)),
      resolution_(camera.resolution),
      projection_(camera.projection),
      per_pixel_(per_pixel(camera)) {
    right_ = normalized(cross(forward_, camera.up));
    up_ = cross(right_, forward_);
}

std::optional<Vec3> CameraView::direction_at(double x, double y) const {
    const double across = (x - resolution_[0] / 2.0) * per_pixel_;
    const double upwards = (resolution_[1] / 2.0 - y) * per_pixel_;
    switch (projection_) {
        case Projection::perspective:
            return normalized(forward_ + across * right_ + upwards * up_);
        case Projection::fisheye: {
            const double angle = std::hypot(across, upwards);
            if (is_beyond(angle, std::min(kPi, resolution_[0] / 2.0 * per_pixel_))) return std::nullopt;
            const double side = angle > 0 ? std::sin(angle) / angle : 1;
            return normalized(std::cos(angle) * forward_ + side * (across * right_ + upwards * up_));
        }
        case Projection::panorama:
            if (is_beyond(across, kPi) || is_beyond(upwards, kPi / 2)) return std::nullopt;
            return normalized(std::cos(upwards) * (std::cos(across) * forward_ + std::sin(across) * right_) +
                              std::sin(upwards) * up_);
    }
    return std::nullopt;
}

std::vector<bool> blind_pixels(const Camera& camera) {
    const CameraView view(camera);
    std::vector<bool> blind;
    for (int y = 0; y < camera.resolution[1]; ++y) {
        for (int x = 0; x < camera.resolution[0]; ++x) blind.push_back(!view.direction_at(x + 0.5, y + 0.5));
    }
    return blind;
}

}  // namespace stilb::sensors
