// Methods that light patches against path tracing, as patches shrink: verify_patches [SCENE [ROWS]], where
// ROWS is a part of rows' names. In closed scenes of the agreement set means over readings come within 1 %,
// with every first shot and backend. Fails where no row has such a name, too.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "agreement/scenes.h"
#include "patches/backends.h"
#include "run/run.h"

namespace stilb {
namespace {

constexpr std::array kDiffuseScenes{"ClosedBox", "ColouredBox", "Corners"};
constexpr std::array kPhongScenes{"BroadPhong", "NarrowPhong"};
constexpr std::array kSizes_m{0.6, 0.3, 0.15};
constexpr double kTolerance = 0.01;
/// A run is repeated with more paths until its own standard errors are this small. Few directions see the
/// highlights of a narrow lobe: to 0.25 % a row takes more than 70 processor minutes.
constexpr double kNoise = 0.0025, kNoiseOfNarrowLobes = 0.005;
constexpr double kLeastGrowth = 1.5, kMostGrowth = 16;  ///< of the paths
constexpr std::uint64_t kFewestSteps = 128, kFewestParticles = 1 << 18, kFewestSamples = 1 << 9;
constexpr int kMostRuns = 5;
constexpr Vec3 kMiddle{2, 1.5, 1.3};

Sensor floor_grid() {
    IlluminancePoints floor;
    for (int x = 0; x < 4; ++x) {
        for (int y = 0; y < 3; ++y) floor.points.push_back({{0.5 + x, 0.5 + y, 0.3}, {0, 0, 1}});
    }
    return {"illuminance", floor};
}

RunOptions options_of(std::string_view method, double error) {
    RunOptions options;
    options.method = method;
    options.error = error;
    return options;
}

/// All around, but not into lights: what is emitted is the same by all methods.
Sensor sights(const Scene& scene) {
    constexpr int count = 96;
    Luminance all;
    for (int i = 0; i < count; ++i) {  // a spiral over the sphere
        const double z = 1 - (2 * i + 1.0) / count, radius = std::sqrt(1 - z * z);
        const double angle = 2 * std::numbers::pi * i / std::numbers::phi;
        all.sights.emplace_back(
            LineOfSight{kMiddle, {radius * std::cos(angle), radius * std::sin(angle), z}});
    }
    const Sensor sensor{"luminance", all};
    RunOptions emission = options_of("path", 0.1);
    emission.bounces = 0;
    const RunResult emitted = run::measure(scene, {&sensor, 1}, emission);
    Luminance unlit;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (emitted.sensors[0].readings[i].estimate.value == 0) unlit.sights.push_back(all.sights[i]);
    }
    return {"luminance", unlit};
}

/// Of all readings of each sensor.
std::vector<statistics::Estimate> means(const RunResult& result) {
    std::vector<statistics::Estimate> all;
    for (const SensorResult& sensor : result.sensors) all.push_back(sensor.summary.mean);
    return all;
}

struct Way {
    std::string name;
    RunOptions options;
};

Way way_of(std::string_view method, std::uint64_t paths) {
    Way way{std::string(method), {}};
    way.options.method = method;
    way.options.paths = paths;
    way.options.replicates = 8;  // walks begin with steps that do not count
    return way;
}

Way bundle_way(estimators::FirstShotVariant variant, patches::BufferBackend backend) {
    Way way = way_of("ray-bundle", kFewestSteps);
    way.name += fmt::format(" {} {}", name_of(variant), name_of(backend));
    way.options.patches.first_shot.variant = variant;
    way.options.patches.first_shot.shooting.backend = backend;
    return way;
}

/// Where all is diffuse, classical and diffuse first shot are the same as incoming.
std::vector<Way> ways(bool is_diffuse) {
    using enum estimators::FirstShotVariant;
    std::vector<Way> all{bundle_way(incoming, patches::BufferBackend::rays),
                         bundle_way(on_the_fly, patches::BufferBackend::rays)};
    if (!is_diffuse) {
        all.push_back(bundle_way(classical, patches::BufferBackend::rays));
        all.push_back(bundle_way(diffuse, patches::BufferBackend::rays));
    }
    if (const auto missing = patches::missing_opengl()) {
        fmt::print("No OpenGL here: {}\n", *missing);
    } else {
        all.push_back(bundle_way(incoming, patches::BufferBackend::opengl));
    }
    if (!is_diffuse) return all;
    all.push_back(way_of("radiosity", kFewestSamples));
    all.push_back(way_of("particles", kFewestParticles));
    return all;
}

/// Relative to path tracing: of a mean over readings.
struct Difference {
    double value = 0, own_error = 0, error = 0;  ///< standard errors, alone and with that of path tracing
};

Difference difference(const statistics::Estimate& found, const statistics::Estimate& expected) {
    const double own = std::isfinite(found.standard_error) ? found.standard_error : 0;  // without chance
    return {found.value / expected.value - 1, own / expected.value,
            std::hypot(own, expected.standard_error) / expected.value};
}

std::vector<Difference> differences(const Scene& scene, std::span<const Sensor> sensors, RunOptions options,
                                    std::span<const statistics::Estimate> expected, double wanted_noise) {
    std::vector<Difference> all;
    for (int run = 0; run < kMostRuns; ++run) {
        const RunResult result = run::measure(scene, sensors, options);
        const auto found = means(result);
        all.clear();
        double noise = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            all.push_back(difference(found[i], expected[i]));
            noise = std::max(noise, all.back().own_error / wanted_noise);
        }
        if (noise < 1) break;
        const double growth = std::clamp(1.3 * noise * noise, kLeastGrowth, kMostGrowth);
        // A run makes at least a batch for each replicate, however few samples are asked for.
        *options.paths = static_cast<std::uint64_t>(growth * static_cast<double>(result.samples));
    }
    return all;
}

/// How many rows there are, and in how many of them all holds.
struct Rows {
    int all = 0, good = 0;
};

void verify(const AgreementScene& entry, std::span<Way> chosen, Rows& rows) {
    const Scene scene = entry.make();
    const std::array sensors{floor_grid(), sights(scene)};
    const auto expected = means(run::measure(scene, sensors, options_of("path", 0.01)));
    const double wanted_noise = entry.name == "NarrowPhong" ? kNoiseOfNarrowLobes : kNoise;
    for (Way& way : chosen) {
        bool holds = true;
        fmt::print("{:12} {:34}", entry.name, way.name);
        for (const double size_m : kSizes_m) {
            way.options.patch_m = size_m;
            // Bins of directions are part of what classical first shot divides.
            way.options.patches.first_shot.bin_rings = static_cast<int>(4.8 / size_m);
            fmt::print(" | {:4} m", size_m);
            for (const Difference& one : differences(scene, sensors, way.options, expected, wanted_noise)) {
                fmt::print(" {:+6.2f} +- {:4.2f} %", 100 * one.value, 100 * one.error);
                const bool is_sure = one.own_error < wanted_noise;
                if (size_m == kSizes_m.back()) holds = holds && is_sure && std::abs(one.value) < kTolerance;
            }
            std::fflush(stdout);
        }
        fmt::print("\n");
        ++rows.all;
        rows.good += holds;
    }
}

}  // namespace
}  // namespace stilb

int main(int count, char** arguments) {
    using namespace stilb;
    const std::string_view scene = count > 1 ? arguments[1] : "", name = count > 2 ? arguments[2] : "";
    fmt::print("Mean illuminance near the floor and mean luminance around, against path tracing\n");
    Rows rows;
    for (const AgreementScene& entry : agreement_scenes()) {
        const auto is_one_of = [&](const auto& names) {
            return std::ranges::find(names, entry.name) != names.end();
        };
        const bool is_diffuse = is_one_of(kDiffuseScenes);
        if (!is_diffuse && !is_one_of(kPhongScenes)) continue;
        if (!scene.empty() && entry.name != scene) continue;
        std::vector<Way> chosen = ways(is_diffuse);
        std::erase_if(chosen, [&](const Way& way) { return way.name.find(name) == std::string::npos; });
        if (!chosen.empty()) verify(entry, chosen, rows);
    }
    fmt::print("{} of {} rows hold\n", rows.good, rows.all);
    return rows.all > 0 && rows.good == rows.all ? 0 : 1;
}
