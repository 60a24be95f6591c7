// How often the intervals of ratings hold, and how often verdicts are wrong: verify_ratings [SEEDS]. Mean,
// minimum, uniformity and diversity of a grid, derived values, ratings of glare, and requirements of exactly
// the true value, in a furnished room. The truth comes from a long run. Fails where an interval holds in less
// than 92 % of the runs, where one that is not conservative holds in more than 98 %, or where more than 7 %
// of the verdicts on the true value are given (5 % and three standard errors of 400 seeds).
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb {
namespace {

constexpr double kLeast = 92, kMost = 98, kMostByChance = 7;  // per cent
constexpr std::uint64_t kTruthSeed = 1'000'000;

Scene furnished_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, diffuse(0.5));
    add_object(scene, Box{{1, 1, 0}, {2, 2, 0.7}}, diffuse(0.3));
    add_object(scene, Box{{3, 0, 0}, {4, 0.6, 1.8}}, diffuse(0.4));
    add_area_light(scene, Rectangle{{1.5, 1.5, 2.9}, {0, 1, 0}, {1, 0, 0}}, Rgb::grey(1000));
    return scene;
}

Sensor derived(std::string_view name, const std::string& formula) {
    return {std::string(name), Derived{Expression(formula)}};
}

/// The desk lies in the open, so that many readings are nearly its minimum; a corner of the floor beside the
/// cabinet is its clear one.
std::vector<Sensor> all_sensors() {
    return {{"desk", Grid{{0.5, 2.5, 0.8}, {3, 0, 0}, {0, 1, 0}, {6, 2}}},
            {"floor", Grid{{2.2, 0.8, 0}, {1.6, 0, 0}, {0, 1.6, 0}, {3, 3}}},
            {"eye", Cylindrical{{{2.5, 2.5, 1.2}}}},
            {"sight", Luminance{{LineOfSight{{2.5, 2.5, 1.2}, {-1, 0, 0}}}}},
            {"glare", Ugr{{{{2, 3.9, 1.2}, {0, -1, 0}}, {{3.9, 2, 1.2}, {-1, 0, 0}}}}},
            derived("eye / desk[5]", "eye / desk[5]"),
            derived("desk.mean / floor.mean", "desk.mean / floor.mean"),
            derived("floor.minimum / desk.mean", "floor.minimum / desk.mean"),
            derived("desk.mean - floor.maximum", "desk.mean - floor.maximum"),
            derived("sight / eye * 3.1416", "sight / eye * 3.1416")};
}

/// One estimate of all runs. Intervals of minima and maxima may be wider than 95 % needs.
struct Tally {
    std::string name;
    double truth = 0;
    bool is_conservative = false;
    std::size_t held = 0, runs = 0;

    double percent() const { return 100 * static_cast<double>(held) / static_cast<double>(runs); }
    bool is_wrong() const { return percent() < kLeast || (!is_conservative && percent() > kMost); }
};

/// All estimates that are tested, in one order.
std::vector<std::pair<Tally, statistics::Estimate>> estimates_of(const RunResult& result) {
    std::vector<std::pair<Tally, statistics::Estimate>> all;
    for (const SensorResult& sensor : result.sensors) {
        if (sensor.readings.size() == 1) {
            const std::string& name = sensor.sensor.name;
            const bool is_conservative = name.find("imum") != std::string::npos;
            all.push_back({{name, 0, is_conservative}, sensor.readings[0].estimate});
            continue;
        }
        for (std::size_t i = 0; i < kStatisticNames.size(); ++i) {
            const auto statistic = static_cast<Statistic>(i);
            if (is_ratio(statistic) && !sensor.sensor.has_ratios()) continue;
            all.push_back({{fmt::format("{}.{}", sensor.sensor.name, name_of(statistic)), 0,
                            statistic != Statistic::mean},
                           sensor.summary[statistic]});
        }
    }
    return all;
}

/// Seeds first + 1 ... last.
std::vector<RunResult> run_seeds(const Scene& scene, std::span<const Sensor> sensors, RunOptions options,
                                 std::size_t first, std::size_t last) {
    std::vector<RunResult> results(last - first);
    options.threads = 1;
    parallel_for(results.size(), [&](std::size_t i) {
        RunOptions own = options;
        own.seed = first + i + 1;
        results[i] = run::measure(scene, sensors, own);
    });
    return results;
}

void add_runs(const Scene& scene, const RunOptions& options, std::size_t first, std::size_t last,
              std::vector<Tally>& tallies) {
    for (const RunResult& result : run_seeds(scene, all_sensors(), options, first, last)) {
        const auto estimates = estimates_of(result);
        for (std::size_t t = 0; t < tallies.size(); ++t) {
            const statistics::Estimate& estimate = estimates[t].second;
            tallies[t].held += estimate.lower <= tallies[t].truth && tallies[t].truth <= estimate.upper;
            ++tallies[t].runs;
        }
    }
}

/// Prints a table; returns whether all intervals hold as often as they should. Where one does not, four times
/// as many seeds decide: 400 leave a standard error of 1.1 %.
bool cover(std::string_view run, const Scene& scene, const RunOptions& options, const RunResult& truth,
           std::size_t seeds) {
    std::vector<Tally> tallies;
    for (auto& [tally, exact] : estimates_of(truth)) {
        tallies.push_back(std::move(tally));
        tallies.back().truth = exact.value;
    }
    add_runs(scene, options, 0, seeds, tallies);
    if (std::ranges::any_of(tallies, &Tally::is_wrong)) add_runs(scene, options, seeds, 4 * seeds, tallies);
    for (const Tally& tally : tallies) {
        fmt::print("| {} | {} | {:.1f} % |{}\n", run, tally.name, tally.percent(),
                   tally.is_wrong() ? " WRONG" : "");
    }
    std::fflush(stdout);
    return std::ranges::none_of(tallies, &Tally::is_wrong);
}

/// How many runs come to a verdict though the true value is required.
bool judge(std::string_view key, const Sensor& sensor, double truth, const Scene& scene, RunOptions options,
           std::size_t seeds) {
    std::vector<Sensor> required = all_sensors();
    const auto found = std::ranges::find(required, sensor.name, &Sensor::name);
    found->requirements.push_back(
        {std::ranges::find(sensors::kCriteria, key, &sensors::Criterion::key), truth});
    options.time_s = 1e6;  // with it, the run looks at the requirement; the paths end it
    std::size_t passes = 0, fails = 0;
    for (const RunResult& result : run_seeds(scene, required, options, 0, seeds)) {
        passes += verdict_of(result) == Verdict::pass;
        fails += verdict_of(result) == Verdict::fail;
    }
    const double share = 100 * static_cast<double>(passes + fails) / static_cast<double>(seeds);
    const bool is_seldom = share <= kMostByChance;
    fmt::print("| {} of {} as it is | {} pass, {} fail | {:.1f} % |{}\n", key, sensor.name, passes, fails,
               share, is_seldom ? "" : " TOO MANY");
    std::fflush(stdout);
    return is_seldom;
}

int verify(std::size_t seeds) {
    const Scene scene = furnished_room();
    RunOptions options;
    options.method = "auto";
    options.seed = kTruthSeed;
    options.paths = 1 << 24;
    const RunResult truth = run::measure(scene, all_sensors(), options);
    bool is_right = true;
    for (const char* method : {"auto", "path"}) {
        RunOptions fixed;
        fixed.method = method;
        fixed.paths = 8192;
        is_right = cover(fmt::format("{}, 8192 paths", method), scene, fixed, truth, seeds) && is_right;
    }
    RunOptions by_error;
    by_error.error = 0.02;
    by_error.target = "mean";
    is_right = cover("auto, means to 2 %", scene, by_error, truth, seeds) && is_right;
    RunOptions looking;
    looking.paths = 1 << 16;
    const auto of = [&](std::string_view name) -> const SensorResult& {
        return *std::ranges::find(truth.sensors, name, [](const SensorResult& s) { return s.sensor.name; });
    };
    is_right =
        judge("mean", of("desk").sensor, of("desk").summary.mean.value, scene, looking, seeds) && is_right;
    is_right =
        judge("minimum", of("floor").sensor, of("floor").summary.minimum.value, scene, looking, seeds) &&
        is_right;
    is_right =
        judge("uniformity", of("desk").sensor, of("desk").summary.uniformity.value, scene, looking, seeds) &&
        is_right;
    is_right = judge("ugr", of("glare").sensor, of("glare").summary.maximum.value, scene, looking, seeds) &&
               is_right;
    is_right = judge("maximum", of("eye / desk[5]").sensor, of("eye / desk[5]").summary.maximum.value, scene,
                     looking, seeds) &&
               is_right;
    return is_right ? 0 : 1;
}

}  // namespace
}  // namespace stilb

int main(int argument_count, char** arguments) {
    const int seeds = argument_count > 1 ? std::atoi(arguments[1]) : 400;
    return stilb::verify(static_cast<std::size_t>(std::max(seeds, 1)));
}
