// The cost of keeping light apart, one thread: the time of a batch with 1 and with 20 groups of lights, and
// with 8 numbers of reflections, over that without, for grids of readings and for pictures.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "efficiency.h"
#include "estimators/estimator_list.h"
#include "rooms.h"
#include "transport/receiver.h"

namespace stilb {
namespace {

constexpr std::uint32_t kLamps = 20;
/// Those of --by bounce.
constexpr std::size_t kOrders = 8;
constexpr int kRepetitions = 7;

/// A room with 20 panels under its ceiling, and four balls.
Scene room_with_panels() {
    Scene scene = make_room(4);
    scene.lights.clear();
    for (std::uint32_t i = 0; i < kLamps; ++i) {
        const double x = 0.4 + 0.7 * (i % 5), y = 0.4 + 0.9 * (i / 5);
        scene.objects.push_back(
            {fmt::format("panel {}", i), Rectangle{{x, y, 2.98}, {0, 0.3, 0}, {0.3, 0, 0}}, {MaterialId{0}}});
        scene.lights.push_back(
            {"", AreaLight{ObjectId{static_cast<std::uint32_t>(scene.objects.size() - 1)}, Rgb::grey(3000)}});
    }
    return scene;
}

transport::Channels channels_of(std::uint32_t groups) {
    transport::Channels channels;
    for (std::uint32_t g = 0; g < groups; ++g) channels.groups.names.push_back(fmt::format("{}", g));
    for (std::uint32_t i = 0; i < kLamps; ++i) channels.groups.of_light.push_back(i % groups);
    return channels;
}

/// The processor time of a batch or of a pass, the least of some.
double seconds_of(const estimators::Estimator& estimator, std::size_t readings, std::size_t channels,
                  std::uint64_t samples, int repetition) {
    const double start = processor_s();
    if (readings > 0) {
        estimators::Tally sums(readings, 0, channels);
        estimator.run_batch({math::RandomKey{1}, samples * static_cast<std::uint64_t>(repetition), samples},
                            sums);
    } else {
        const auto pass = estimator.start({math::RandomKey{1}, static_cast<std::uint64_t>(repetition)});
        for (const estimators::PixelBlock& block : estimators::blocks_of({128, 96})) {
            estimators::Tally sums(block.pixels(), 0, channels);
            pass->sample(block, sums);
        }
    }
    return processor_s() - start;
}

void compare(const Scene& scene, const rays::RayCaster& caster, std::string_view technique,
             std::uint64_t samples, const std::vector<Measurand>& measurands) {
    const transport::Channels one = channels_of(1), all = channels_of(kLamps);
    transport::Channels by_bounce = channels_of(1);
    by_bounce.orders = kOrders;
    const std::array<const transport::Channels*, 4> channels{nullptr, &one, &all, &by_bounce};
    std::array<double, channels.size()> best_s{};
    best_s.fill(std::numeric_limits<double>::infinity());
    std::vector<std::unique_ptr<estimators::Estimator>> estimators;
    for (const transport::Channels* own : channels) {
        estimators::Problem problem{.scene = scene,
                                    .caster = caster,
                                    .max_reflections = transport::kUnlimited,
                                    .measurands = measurands,
                                    .channels = own};
        if (measurands.empty())
            problem.camera =
                Camera{.position = {0.5, 0.5, 1.6}, .target = {3, 3, 1}, .resolution = {128, 96}};
        estimators.push_back(estimators::find_estimator(technique).make(problem));
    }
    // In turns, so that other work on the machine meets all of them.
    for (int repetition = 0; repetition < kRepetitions; ++repetition) {
        for (std::size_t i = 0; i < best_s.size(); ++i)
            best_s[i] =
                std::min(best_s[i], seconds_of(*estimators[i], measurands.size(),
                                               channels[i] ? channels[i]->count() : 0, samples, repetition));
    }
    fmt::print("{:12} {:9} {:9.4f} {:8.3f} {:8.3f} {:8.3f}\n", technique,
               measurands.empty() ? "picture" : "grid", best_s[0], best_s[1] / best_s[0],
               best_s[2] / best_s[0], best_s[3] / best_s[0]);
}

}  // namespace
}  // namespace stilb

int main() {
    using namespace stilb;
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const Scene scene = room_with_panels();
    const rays::RayCaster caster(scene);
    fmt::print("Time with channels over that without.\n\n{:12} {:9} {:>9} {:>8} {:>8} {:>8}\n", "technique",
               "of", "none s", "1", "20", "bounces");
    const std::vector<Measurand> grid = make_grid(16);
    compare(scene, caster, "path", 256, grid);
    compare(scene, caster, "light-paths", 8192, grid);
    compare(scene, caster, "guided", 16, grid);
    for (const std::string_view technique : {"path", "light-paths", "guided"})
        compare(scene, caster, technique, 1, {});
}
