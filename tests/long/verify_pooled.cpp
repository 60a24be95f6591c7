// How often 95 % intervals hold whose errors are pooled, those of pixels and of large grids: verify_pooled
// [SEEDS] [CASES]: those whose names contain this text, or all. Rooms with diffuse and glossy surfaces, by a
// number of passes or paths, and by error. The truth is the mean of all seeds, which the error of one seed
// hardly moves. Fails where the mean coverage is not from 92 to 98 %, or where intervals that are a third too
// narrow would not be found.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

#include "agreement/scenes.h"
#include "base/parallel.h"
#include "materials/phong.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb {
namespace {

constexpr double kLeast = 92, kMost = 98;  // per cent
/// Two-sided 95 % for the 23 degrees of freedom that most pixels have.
constexpr double kQuantile = 2.07;
/// Intervals of this share of their width must be found.
constexpr double kPlanted = 0.67;

Scene room_with_box() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.5));
    add_object(scene, Box{{1.7, 0.6, 0.001}, {2.5, 1.4, 0.7}}, diffuse(0.5));
    add_area_light(scene, Rectangle{{1.1, 1.1, 2.99}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(2500));
    return scene;
}

Scene glossy_room() {
    Scene scene = room_with_box();
    add_object(scene, Rectangle{{0, 0, 0.0005}, {3, 0, 0}, {0, 3, 0}},
               Phong{Rgb::grey(0.3), Rgb::grey(0.3), 30});
    return scene;
}

Sensor camera() {
    return {"camera",
            Camera{{1.5, 0.1, 1.6}, {0, 1, -0.15}, {0, 0, 1}, 80, {48, 48}, Projection::perspective}};
}

Sensor grid() { return {"grid", Grid{{0, 0, 0.8}, {3, 0, 0}, {0, 3, 0}, {48, 48}, Vec3{0, 0, 1}}}; }

struct Case {
    std::string_view name;
    Scene (*make)();
    Sensor (*sensor)();
    std::string_view method;
    std::optional<std::uint64_t> paths;  ///< passes of pictures
    std::optional<double> error;
};

const Case kCases[] = {
    {"room, auto, 8 passes", room_with_box, camera, "auto", 8, {}},
    {"room, auto, 10 %", room_with_box, camera, "auto", {}, 0.1},
    {"room, path, 32 passes", room_with_box, camera, "path", 32, {}},
    {"room, path, 20 %", room_with_box, camera, "path", {}, 0.2},
    {"glossy room, auto, 8 passes", glossy_room, camera, "auto", 8, {}},
    {"glossy room, auto, 20 %", glossy_room, camera, "auto", {}, 0.2},
    {"point light, auto, 8 passes", closed_box, camera, "auto", 8, {}},
    {"point light, auto, 10 %", closed_box, camera, "auto", {}, 0.1},
    {"room, grid, auto, 64 paths", room_with_box, grid, "auto", 64, {}},
    {"room, grid, auto, 2 %", room_with_box, grid, "auto", {}, 0.02},
    {"room, grid, path, 10 %", room_with_box, grid, "path", {}, 0.1},
    {"glossy room, grid, auto, 128", glossy_room, grid, "auto", 128, {}},
    {"glossy room, grid, auto, 2 %", glossy_room, grid, "auto", {}, 0.02},
    {"point light, grid, auto, 1 %", closed_box, grid, "auto", {}, 0.01},
};

struct Runs {
    std::vector<std::vector<statistics::Estimate>> estimates;  ///< by seeds, then by pixels or readings

    /// The share of all intervals, `width` times as wide as stated, that hold the truth [%]; for each
    /// value.
    std::vector<double> coverage(double width) const {
        const double share = 1 / static_cast<double>(estimates.size());
        std::vector<double> held(estimates[0].size());
        for (std::size_t i = 0; i < held.size(); ++i) {
            double truth = 0;
            for (const auto& of_seed : estimates) truth += share * of_seed[i].value;
            for (const auto& of_seed : estimates) {
                const auto& [value, error, lower, upper] = of_seed[i];
                const double missing = truth - value;
                const bool holds = width * (lower - value) <= missing && missing <= width * (upper - value);
                held[i] += holds ? 100 * share : 0;
            }
        }
        return held;
    }
};

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

Runs runs_of(const Case& of, std::size_t seeds) {
    const Scene scene = of.make();
    const Sensor sensor = of.sensor();
    Runs runs{std::vector<std::vector<statistics::Estimate>>(seeds)};
    parallel_for(seeds, [&](std::size_t s) {
        RunOptions options;
        options.method = of.method;
        options.paths = of.paths;
        options.error = of.error;
        options.seed = s + 1;
        options.threads = 1;
        if (sensor.camera() == nullptr) {
            const RunResult result = run::measure(scene, {&sensor, 1}, options);
            for (const Reading& reading : result.sensors[0].readings)
                runs.estimates[s].push_back(reading.estimate);
            return;
        }
        const RenderResult result = run::render(scene, sensor, options);
        for (std::size_t i = 0; i < result.depth_m.size(); ++i) {
            const auto& [r, g, b] = result.pixels.rgb_cd_m2[i];
            const double value = Rgb{{r, g, b}}.luminance();
            const double error{result.pixels.standard_error_cd_m2[i]};
            runs.estimates[s].push_back({value, error, value - kQuantile * error, value + kQuantile * error});
        }
    });
    return runs;
}

bool verify(const Case& of, std::size_t seeds) {
    const Runs runs = runs_of(of, seeds);
    const std::vector<double> held = runs.coverage(1);
    const double all = mean(held), planted = mean(runs.coverage(kPlanted));
    double rare = 0;
    for (const double of_one : held) rare += of_one < 90 ? 100 / static_cast<double>(held.size()) : 0;
    const bool good = all >= kLeast && all <= kMost && planted < kLeast;
    fmt::print("{:30} {:6.2f} % {:10.2f} % {:10.2f} % {}\n", of.name, all, rare, planted,
               good ? "" : "WRONG");
    std::fflush(stdout);
    return good;
}

}  // namespace
}  // namespace stilb

int main(int argc, char** argv) {
    const std::size_t seeds = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 400;
    const std::string_view chosen = argc > 2 ? argv[2] : "";
    fmt::print("{:30} {:>8} {:>12} {:>12}\n", "48 x 48 pixels or points", "holds", "some < 90", "planted");
    std::size_t cases = 0, good = 0;
    for (const stilb::Case& of : stilb::kCases) {
        if (of.name.find(chosen) == std::string_view::npos) continue;
        ++cases;
        good += stilb::verify(of, seeds);
    }
    fmt::print("{} of {} cases hold\n", good, cases);
    return cases > 0 && good == cases ? EXIT_SUCCESS : EXIT_FAILURE;
}
