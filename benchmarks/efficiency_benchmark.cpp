// Efficiency of `auto` and `double-local` over `path` for every kind of sensor in a furnished room, one
// thread. At points double-local is local. Preparation is not counted.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include "efficiency.h"
#include "estimators/estimator.h"
#include "estimators/estimator_list.h"
#include "rooms.h"
#include "sensors/goniometer.h"
#include "transport/receiver.h"

namespace stilb {
namespace {

Efficiency of_readings(const estimators::EstimatorEntry& method, const Scene& scene,
                       const std::vector<Measurand>& measurands) {
    const rays::RayCaster caster(scene);
    const auto estimator =
        method.make({scene, caster, transport::kUnlimited, {math::RandomKey{5}}, measurands});
    return efficiency_of(readings_with(*estimator), estimator->batch_granularity());
}

Efficiency of_picture(const estimators::EstimatorEntry& method, const Scene& scene, const Camera& camera) {
    const rays::RayCaster caster(scene);
    const auto estimator = method.make({.scene = scene,
                                        .caster = caster,
                                        .max_reflections = transport::kUnlimited,
                                        .preparation_key = {math::RandomKey{5}},
                                        .camera = camera});
    return efficiency_of(picture_with(*estimator, camera.resolution), 1);
}

/// `efficiency`: of a method.
template <typename EfficiencyOf>
void compare(std::string_view what, const EfficiencyOf& efficiency) {
    const Efficiency path = efficiency(estimators::find_estimator("path"));
    for (const std::string_view name : {"auto", "double-local"}) {
        const Efficiency e = efficiency(estimators::find_estimator(name));
        fmt::print("{:32} {:12} {:8.1f} {:8.1f} {:8.1f}   {:4.1f} {:4.1f}\n", what, name,
                   e.by_mean / path.by_mean, e.by_median / path.by_median,
                   e.by_95_percent / path.by_95_percent, e.cpu_s, path.cpu_s);
        std::fflush(stdout);
    }
}

void compare_readings(std::string_view what, const Scene& scene, const std::vector<Measurand>& measurands) {
    compare(what,
            [&](const estimators::EstimatorEntry& method) { return of_readings(method, scene, measurands); });
}

/// Rows of 32 x 32 lines of sight from eye level onto the lower half of the room.
std::vector<Measurand> lines_of_sight() {
    constexpr int count = 32;
    const Vec3 eye{0.5, 0.4, 1.6};
    std::vector<Measurand> lines;
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) {
            const Vec3 target{0.1 + 3.8 * (i + 0.5) / count, 3.9, 1.6 * (j + 0.5) / count};
            lines.push_back(LineOfSight{eye, normalized(target - eye)});
        }
    }
    return lines;
}

std::vector<Measurand> goniometer() {
    Goniometer place;
    place.point = {1.1, 2.3, 0};
    place.step_deg = 10;
    return Sensor{"goniometer", place}.measurands();
}

Camera camera() {
    Camera result;
    result.position = {0.5, 0.4, 1.6};
    result.target = {2.6, 3, 0.8};
    result.fov_deg = 70;
    result.resolution = {96, 64};
    return result;
}

void compare_all() {
    const Scene matt = make_room(30);
    const Scene glossy = make_glossy_room(30);
    compare_readings("illuminance, 64 x 64 points", matt, make_grid(64));
    compare_readings("luminance, 1024 lines of sight", matt, lines_of_sight());
    compare_readings("  the same, glossy surfaces", glossy, lines_of_sight());
    compare_readings("goniometer, 289 directions", matt, goniometer());
    compare_readings("  the same, glossy surfaces", glossy, goniometer());
    const auto of_camera = [](const Scene& scene) {
        return [&](const estimators::EstimatorEntry& method) { return of_picture(method, scene, camera()); };
    };
    compare("camera, 96 x 64 pixels", of_camera(matt));
    compare("  the same, glossy surfaces", of_camera(glossy));
}

}  // namespace
}  // namespace stilb

int main() {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    fmt::print(
        "Efficiency 1 / (variance x time) over path tracing, room with clutter\n"
        "{:32} {:12} {:>8} {:>8} {:>8}   {:>9}\n",
        "", "", "mean", "median", "95 %", "s, of path");
    stilb::compare_all();
}
