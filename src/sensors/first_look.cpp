#include "sensors/first_look.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>

#include "sensors/areas/plane_region.h"
#include "sensors/areas/working_planes.h"

namespace stilb::sensors {
namespace {

constexpr std::array<int, 2> kResolution{720, 480};
constexpr double kFovInside_deg = 90, kFovOutside_deg = 50;
/// Inside, heights above the floor, and the distance from walls.
constexpr double kEyes_m = 1.6, kTarget_m = 1, kFromWalls_m = 0.4;
/// The distance from outside, over that at which all is just in the picture.
constexpr double kFromOutside = 1.1, kLeast_m = 1e-3;
constexpr double kIlluminance_lx = 500;
constexpr std::size_t kMostRooms = 32;
constexpr double kSky_cd_m2 = 50;

Vec3 middle_of(const std::vector<Vec3>& corners) {
    Vec3 sum;
    for (const Vec3& corner : corners) sum += corner;
    return sum / static_cast<double>(corners.size());
}

/// Planes at the height of the eyes, the largest first.
std::vector<WorkingPlane> rooms_of(const Scene& scene, const rays::RayCaster& caster) {
    auto planes = working_planes(scene, caster, {.height_m = kEyes_m, .margin_m = kFromWalls_m});
    std::ranges::stable_sort(planes, std::greater(),
                             [](const WorkingPlane& plane) { return area_m2(plane.polygon); });
    return planes;
}

/// All of the scene is in its picture.
Camera camera_outside(const Scene& scene) {
    const Bounds bounds = scene::bounds_of(scene);
    Camera camera;
    camera.resolution = kResolution;
    camera.fov_deg = kFovOutside_deg;
    camera.target = bounds.middle();
    const Vec3 back = normalized({-0.6, -0.7, 0.4});
    camera.position = camera.target + back;
    const CameraView view(camera);
    const double across = std::tan(kFovOutside_deg / 2 * kPi / 180),
                 upwards = across * kResolution[1] / kResolution[0];
    double distance_m = kLeast_m;
    for (const double x : {bounds.min.x, bounds.max.x})
        for (const double y : {bounds.min.y, bounds.max.y})
            for (const double z : {bounds.min.z, bounds.max.z}) {
                const Vec3 corner = Vec3{x, y, z} - camera.target;
                const double aside = std::max(std::abs(dot(corner, view.right())) / across,
                                              std::abs(dot(corner, view.up())) / upwards);
                distance_m = std::max(distance_m, dot(corner, back) + aside);
            }
    camera.position = camera.target + kFromOutside * distance_m * back;
    return camera;
}

/// The middle of a room, or a corner where the middle is not in it.
Vec3 place_in(const PolygonInSpace& room) {
    const auto is_in = [](const std::vector<Vec3>& corners, const Vec3& point) {
        Ring ring;
        for (const Vec3& corner : corners) ring.push_back({corner.x, corner.y});
        return contains(ring, {point.x, point.y}, 0);
    };
    const Vec3 middle = middle_of(room.outline);
    const bool is_room =
        is_in(room.outline, middle) &&
        std::ranges::none_of(room.holes, [&](const std::vector<Vec3>& hole) { return is_in(hole, middle); });
    return is_room ? middle : room.outline.front();
}

}  // namespace

Sensor camera_for_first_look(const Scene& scene, const rays::RayCaster& caster) {
    const std::vector<WorkingPlane> rooms = rooms_of(scene, caster);
    Camera camera = camera_outside(scene);
    if (rooms.empty()) return {"preview", camera};
    const std::vector<Vec3>& outline = rooms.front().polygon.outline;
    const Vec3 middle = middle_of(outline);
    camera.fov_deg = kFovInside_deg;
    camera.position = *std::ranges::max_element(
        outline, {}, [&](const Vec3& corner) { return squared_length(corner - middle); });
    camera.target = {middle.x, middle.y, rooms.front().floor_m + kTarget_m};
    return {"preview", camera};
}

std::vector<Light> lights_for_first_look(const Scene& scene, const rays::RayCaster& caster) {
    std::vector<Light> lights;
    const auto add_bulb = [&](const std::string& name, const Vec3& position, double squared_m2,
                              std::string_view group) {
        lights.push_back(
            {name, PointLight{position, Rgb::grey(kIlluminance_lx * squared_m2)}, std::string(group)});
    };
    for (const WorkingPlane& room : rooms_of(scene, caster)) {
        if (lights.size() == kMostRooms) break;
        add_bulb("bulb " + std::to_string(lights.size() + 1), place_in(room.polygon),
                 area_m2(room.polygon) / 4, "first look: rooms");
    }
    const Camera outside = camera_outside(scene);
    constexpr std::string_view group = "first look: outside";
    add_bulb("bulb outside", outside.position, squared_length(outside.target - outside.position), group);
    lights.push_back({"sky", EnvironmentLight{Rgb::grey(kSky_cd_m2)}, std::string(group)});
    return lights;
}

Scene with_headlight(Scene scene, const Camera& camera) {
    const double squared_m2 = squared_length(camera.target - camera.position);
    scene.lights = {Light{"headlight", PointLight{camera.position, Rgb::grey(kIlluminance_lx * squared_m2)}}};
    return scene;
}

}  // namespace stilb::sensors
