#include "sensors/first_look.h"

#include <algorithm>
#include <cmath>

#include "sensors/areas/working_planes.h"

namespace stilb::sensors {
namespace {

constexpr std::array<int, 2> kResolution{720, 480};
constexpr double kFovInside_deg = 90, kFovOutside_deg = 50;
/// Inside, heights above the floor, and the distance from walls.
constexpr double kEyes_m = 1.6, kTarget_m = 1, kFromWalls_m = 0.4;
/// The distance from outside, in half diagonals: all is in the picture.
constexpr double kFromOutside = 2.2, kLeast_m = 1e-3;
constexpr double kIlluminance_lx = 500;

Vec3 middle_of(const std::vector<Vec3>& corners) {
    Vec3 sum;
    for (const Vec3& corner : corners) sum += corner;
    return sum / static_cast<double>(corners.size());
}

}  // namespace

Sensor camera_for_first_look(const Scene& scene, const rays::RayCaster& caster) {
    Camera camera;
    camera.resolution = kResolution;
    const auto planes = working_planes(scene, caster, {.height_m = kEyes_m, .margin_m = kFromWalls_m});
    const auto largest = std::ranges::max_element(
        planes, {}, [](const WorkingPlane& plane) { return area_m2(plane.polygon); });
    if (largest == planes.end()) {
        const Bounds bounds = scene::bounds_of(scene);
        const double radius_m = std::max(length(bounds.max - bounds.min) / 2, kLeast_m);
        camera.fov_deg = kFovOutside_deg;
        camera.target = bounds.middle();
        camera.position = camera.target + kFromOutside * radius_m * normalized({-0.6, -0.7, 0.4});
        return {"preview", camera};
    }
    const std::vector<Vec3>& outline = largest->polygon.outline;
    const Vec3 middle = middle_of(outline);
    camera.fov_deg = kFovInside_deg;
    camera.position = *std::ranges::max_element(
        outline, {}, [&](const Vec3& corner) { return squared_length(corner - middle); });
    camera.target = {middle.x, middle.y, largest->floor_m + kTarget_m};
    return {"preview", camera};
}

Scene with_headlight(Scene scene, const Camera& camera) {
    const double squared_m2 = squared_length(camera.target - camera.position);
    scene.lights = {Light{"headlight", PointLight{camera.position, Rgb::grey(kIlluminance_lx * squared_m2)}}};
    return scene;
}

}  // namespace stilb::sensors
