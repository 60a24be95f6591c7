// Direct light, one thread: points under an area lamp by closed forms and by sampling, and pictures of a hall
// with 10 to 100,000 luminaires of the same flux in all.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "efficiency.h"
#include "estimators/estimator.h"
#include "estimators/estimator_list.h"
#include "materials/diffuse.h"
#include "rooms.h"
#include "transport/direct/direct_light.h"
#include "transport/direct/one_receiver.h"

namespace stilb {
namespace {

using transport::DirectLight;

// Points under an area lamp.

/// A panel of 0.6 x 0.6 m under the ceiling, and a table.
Scene room_with_panel() {
    Scene scene = make_room(0);
    scene.lights.clear();
    scene.objects.push_back({"table", Box{{1.2, 1.2, 0.7}, {2.8, 2, 0.74}}, {MaterialId{0}}});
    scene.objects.push_back(
        {"panel", Rectangle{{1.7, 1.7, 2.98}, {0, 0.6, 0}, {0.6, 0, 0}}, {MaterialId{0}}});
    scene.lights.push_back({"panel", AreaLight{ObjectId{2}, Rgb::grey(3000)}});
    return scene;
}

std::vector<transport::Receiver> grid(const rays::RayCaster& caster, double height) {
    std::vector<transport::Receiver> receivers;
    const Grid plane{{0.05, 0.05, height}, {3.9, 0, 0}, {0, 3.9, 0}, {64, 64}};
    const auto measurands = Sensor{"grid", plane}.measurands();
    for (std::uint32_t i = 0; i < measurands.size(); ++i)
        receivers.push_back(*transport::receiver_of_illuminance(i, measurands[i], caster));
    return transport::sorted_receivers(std::move(receivers));
}

void print_sampling(std::string_view what, int samples, double seconds, const std::vector<double>& sums,
                    const std::vector<double>& squares) {
    double variance = 0, mean = 0;
    for (std::size_t j = 0; j < sums.size(); ++j) {
        const double m = sums[j] / samples;
        mean += m;
        variance += squares[j] / samples - m * m;
    }
    mean /= static_cast<double>(sums.size());
    variance /= static_cast<double>(sums.size());
    const double ns = 1e9 * seconds / samples / static_cast<double>(sums.size());
    fmt::print("  {:26} {:8.1f} ns a sample   relative sigma {:.4f}   sigma^2 x ns {:.4f}\n", what, ns,
               std::sqrt(std::max(0.0, variance)) / mean, std::max(0.0, variance) / (mean * mean) * ns);
}

void compare_points(std::string_view what, double height) {
    const Scene scene = room_with_panel();
    const rays::RayCaster caster(scene);
    const transport::LightSampler lights(scene, caster);
    const DirectLight direct(scene, caster, lights);
    const std::vector<transport::Receiver> receivers = grid(caster, height);
    constexpr int samples = 64;
    std::vector<double> sums(receivers.size()), squares(receivers.size());
    double start = processor_s();
    for (std::size_t j = 0; j < receivers.size(); ++j) {
        for (std::uint64_t i = 0; i < samples; ++i) {
            math::SampleStream stream(math::RandomKey{1}.derived(j), i);
            const double x = sample_direct_from_areas(receivers[j], caster, lights, stream).luminance();
            sums[j] += x, squares[j] += x * x;
        }
    }
    fmt::print("{}\n", what);
    print_sampling("sampled by solid angle", samples, processor_s() - start, sums, squares);

    start = processor_s();
    const DirectLight::Prepared prepared = direct.prepare(receivers, Monitor::none());
    const double setup_s = processor_s() - start;
    std::ranges::fill(sums, 0), std::ranges::fill(squares, 0);
    std::size_t open = 0;
    start = processor_s();
    for (std::size_t t = 0; t < prepared.remainders.size(); ++t) {
        const auto tile = std::span(receivers).subspan(t * kPacketWidth, kPacketWidth);
        const bool is_open = !prepared.remainders[t].is_empty();
        open += is_open;
        for (std::uint64_t i = 0; i < samples; ++i) {
            DirectLight::TileLight light{};
            if (is_open) {
                std::vector<math::SampleStream> streams;
                for (std::size_t j = 0; j < tile.size(); ++j)
                    streams.emplace_back(math::RandomKey{1}.derived(t).derived(j), i);
                direct.add_sample(tile, prepared.remainders[t], streams, light);
            }
            for (std::size_t j = 0; j < tile.size(); ++j) {
                const double x = light[j].luminance() + prepared.known[t * kPacketWidth + j].luminance();
                sums[t * kPacketWidth + j] += x, squares[t * kPacketWidth + j] += x * x;
            }
        }
    }
    print_sampling("closed form", samples, processor_s() - start, sums, squares);
    fmt::print("  set-up {:.0f} ns a point; {} of {} tiles are sampled\n",
               1e9 * setup_s / static_cast<double>(receivers.size()), open, prepared.remainders.size());
}

// A hall with many luminaires.

/// 50 x 40 x 5 m with 40 boxes; `count` luminaires on a grid below the ceiling.
Scene hall(int count) {
    Scene scene;
    scene.materials.push_back({"wall", Diffuse{Rgb::grey(0.5)}});
    scene.objects.push_back({"hall", Box{{0, 0, 0}, {50, 40, 5}}, {MaterialId{0}}});
    for (int i = 0; i < 40; ++i) {
        const double x = 3 + 6 * (i % 8), y = 4 + 8 * (i / 8);
        scene.objects.push_back({"box", Box{{x, y, 0}, {x + 2, y + 1, 2}}, {MaterialId{0}}});
    }
    const int columns = static_cast<int>(std::lround(std::sqrt(count * 50. / 40))), rows = count / columns;
    for (int i = 0; i < columns * rows; ++i) {
        const Vec3 at{50 * (i % columns + 0.5) / columns, 40 * (i / columns + 0.5) / rows, 4.5};
        scene.lights.push_back({"luminaire", PointLight{at, Rgb::grey(1e5 / (columns * rows))}});
    }
    return scene;
}

Camera camera() {
    Camera result;
    result.position = {1, 1, 1.7};
    result.target = {30, 25, 1};
    result.fov_deg = 70;
    result.resolution = {64, 48};
    return result;
}

/// Prints the set-up time of a picture, and its cost at equal error over the cost with 10 luminaires.
void compare_counts(std::string_view method, int max_reflections) {
    double first = 0;
    for (const int count : {10, 1000, 100'000}) {
        const Scene scene = hall(count);
        double start = processor_s();
        const rays::RayCaster caster(scene);
        const auto estimator =
            estimators::find_estimator(method).make({.scene = scene,
                                                     .caster = caster,
                                                     .max_reflections = max_reflections,
                                                     .preparation_key = {math::RandomKey{5}},
                                                     .camera = camera()});
        const double setup_s = processor_s() - start;
        const Measure measure = picture_with(*estimator, camera().resolution);
        const Efficiency e = efficiency_of(measure, 1);
        if (count == 10) first = e.by_mean;
        constexpr int passes = 8;
        start = processor_s();
        measure(0, passes);
        const double pass_s = (processor_s() - start) / passes;
        fmt::print(
            "  {:6} {:>14} {:8} luminaires: set-up {:6.2f} s, {:8.2f} us a pixel, relative sigma {:.3f}, "
            "cost at "
            "equal error {:7.2f}\n",
            method, max_reflections == 1 ? "direct light" : "all light", count, setup_s,
            1e6 * pass_s / (camera().resolution[0] * camera().resolution[1]),
            std::sqrt(1 / (e.by_mean * pass_s)), first / e.by_mean);
        std::fflush(stdout);
    }
}

void time_readings() {
    for (const int count : {10, 1000, 100'000}) {
        const Scene scene = hall(count);
        const rays::RayCaster caster(scene);
        const transport::LightSampler lights(scene, caster);
        const double start = processor_s();
        const DirectLight direct(scene, caster, lights);
        std::vector<transport::Receiver> receivers;
        const auto measurands =
            Sensor{"grid", Grid{{1, 1, 0.8}, {48, 0, 0}, {0, 38, 0}, {16, 16}}}.measurands();
        for (std::uint32_t i = 0; i < measurands.size(); ++i)
            receivers.push_back(*transport::receiver_of_illuminance(i, measurands[i], caster));
        receivers = transport::sorted_receivers(std::move(receivers));
        direct.prepare(receivers, Monitor::none());
        const double seconds = processor_s() - start;
        fmt::print("  256 points, exact, {:6} luminaires: {:.3f} s, {:.1f} ns a point and luminaire\n", count,
                   seconds, 1e9 * seconds / 256 / count);
    }
}

}  // namespace
}  // namespace stilb

int main() {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    stilb::compare_points("4096 points at 0.8 m, above the table", 0.8);
    stilb::compare_points("4096 points on the floor, some in the table's shadow", 0);
    fmt::print("A hall\n");
    stilb::time_readings();
    for (const int max_reflections : {1, stilb::transport::kUnlimited}) {
        for (const std::string_view method : {"auto", "path"}) stilb::compare_counts(method, max_reflections);
    }
}
