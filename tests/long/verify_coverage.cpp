// How often 95 % intervals hold, and how often a run is wrong without a word: verify_coverage [SEEDS]
// [SCENE]. Scenes whose light is hard to find (tests/long/coverage) and those of the agreement suite; the
// truth comes from one long run of each. Prints the table of docs/statistics.md, and fails where more than 8
// % of a reading's runs miss the truth without a warning, or where the truth is not known well enough to
// tell.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "agreement/scenes.h"
#include "io/scene/scene_file.h"
#include "run/run.h"

namespace stilb {
namespace {

constexpr double kMostWrong = 8;  // per cent
/// Readings above this share of wrong runs are decided by four times as many seeds: 400 seeds leave a
/// standard error of 1.4 %.
constexpr double kCloseToMostWrong = 6;  // per cent
/// The largest standard error of the truth, as a share of the median half-width of the intervals. If the
/// truth is wrong by two such standard errors, the measured coverage is too low by 0.5 %.
constexpr double kMostUncertain = 0.05;
/// Seeds of other runs.
constexpr std::uint64_t kTruthSeed = 1'000'000;

struct Case {
    std::string_view scene;  ///< a file in tests/long/coverage
    std::string_view method;
    std::uint64_t paths = 0;
    double error = 0;  ///< instead of paths
    std::string_view truth_method;
    std::uint64_t truth_paths = 0;
};

constexpr std::uint64_t kMillion = 1 << 20;
/// Cases of one scene follow each other and have one truth.
constexpr Case kCases[] = {
    {"plastic", "auto", 8192, 0, "path", 4 * kMillion},
    {"plastic", "auto", 0, 0.05, "path", 4 * kMillion},
    {"plastic", "path", 0, 0.05, "path", 4 * kMillion},
    {"metal", "auto", 8192, 0, "path", 4 * kMillion},
    {"metal", "path", 8192, 0, "path", 4 * kMillion},
    {"smooth_metal", "auto", 8192, 0, "auto", 8 * kMillion},
    {"smooth_metal", "path", 8192, 0, "auto", 8 * kMillion},
    {"glass_ball", "auto", 8192, 0, "auto", 8 * kMillion},
    {"baffle", "auto", 8192, 0, "auto", 8 * kMillion},
    {"keyhole", "auto", 8192, 0, "path", 16 * kMillion},
    {"corridor", "auto", 65536, 0, "path", 16 * kMillion},
    {"gap", "auto", 2048, 0, "path", 4 * kMillion},
    {"white_box", "auto", 2048, 0, "path", kMillion / 2},
    {"white_box", "path", 2048, 0, "path", kMillion / 2},
    {"beam", "double-local", 8192, 0, "auto", 4 * kMillion},
    {"beam", "auto", 8192, 0, "auto", 4 * kMillion},
    {"eyes", "auto", 0, 0.005, "path", 2 * kMillion},
};

RunOptions options_of(std::string_view method, std::uint64_t seed) {
    RunOptions options;
    options.method = method;
    options.seed = seed;
    return options;
}

/// One reading, over all seeds.
struct Tally {
    std::string name;
    double truth = 0, truth_error = 0;
    std::size_t held = 0, warned = 0, wrong = 0;
    std::vector<double> half_widths{};

    void add(const statistics::Estimate& estimate, bool is_warned) {
        const bool holds = estimate.lower <= truth && truth <= estimate.upper;
        held += holds;
        warned += is_warned;
        wrong += !holds && !is_warned;
        half_widths.push_back(relative_half_width(estimate));
    }
    double percent(std::size_t runs) const {
        return 100 * static_cast<double>(runs) / static_cast<double>(half_widths.size());
    }
    bool is_wrong_too_often() const { return percent(wrong) > kMostWrong; }
    bool is_close() const { return percent(wrong) > kCloseToMostWrong; }
    double median_half_width() {
        const auto middle = half_widths.begin() + static_cast<std::ptrdiff_t>(half_widths.size() / 2);
        std::nth_element(half_widths.begin(), middle, half_widths.end());
        return *middle;
    }
};

/// A warning of the sensor, or of the whole run.
bool is_warned(const RunResult& result, const std::string& sensor) {
    return std::ranges::any_of(texts_of(result.warnings), [&](const std::string& warning) {
        return !warning.starts_with("sensor ") || warning.find('"' + sensor + '"') != std::string::npos;
    });
}

/// The readings, without any seed yet.
std::vector<Tally> tallies_of(const RunResult& truth) {
    std::vector<Tally> tallies;
    for (const SensorResult& sensor : truth.sensors) {
        for (std::size_t j = 0; j < sensor.readings.size(); ++j) {
            const statistics::Estimate& estimate = sensor.readings[j].estimate;
            tallies.push_back({sensor.readings.size() > 1 ? fmt::format("{} {}", sensor.sensor.name, j + 1)
                                                          : sensor.sensor.name,
                               estimate.value, estimate.standard_error});
        }
    }
    return tallies;
}

/// A row of the table. Returns whether the reading is known well and seldom wrong without a warning.
bool print(std::string_view run, Tally& tally) {
    const double truth_error = tally.truth_error / tally.truth, half_width = tally.median_half_width();
    // Where nearly all runs warn, nothing depends on the truth. In the dark, its error is 0 of 0.
    const bool is_known =
        tally.percent(tally.warned) >= 100 - kMostWrong || !(truth_error > kMostUncertain * half_width);
    fmt::print("| {} | {} | {:.3g} ± {:.1g} %{} | {:.2g} % | {:.1f} % | {:.1f} % | {:.1f} %{} |\n", run,
               tally.name, tally.truth, 100 * truth_error, is_known ? "" : " TOO UNCERTAIN", 100 * half_width,
               tally.percent(tally.held), tally.percent(tally.warned), tally.percent(tally.wrong),
               tally.is_wrong_too_often() ? " TOO MANY" : "");
    std::fflush(stdout);
    return is_known && !tally.is_wrong_too_often();
}

/// Adds the runs with seeds first ... last - 1, on all processors, one thread each.
void add_runs(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options,
              std::size_t first, std::size_t last, std::vector<Tally>& tallies) {
    std::vector<RunResult> results(last - first);
    std::atomic<std::size_t> next = 0;
    std::vector<std::jthread> workers;
    for (unsigned t = 0; t < std::max(1u, std::thread::hardware_concurrency()); ++t) {
        workers.emplace_back([&, mine = options]() mutable {
            mine.threads = 1;
            for (std::size_t i = next++; i < results.size(); i = next++) {
                mine.seed = first + i;
                results[i] = run::measure(scene, sensors, mine);
            }
        });
    }
    workers.clear();
    for (const RunResult& result : results) {
        std::size_t reading = 0;
        for (const SensorResult& sensor : result.sensors) {
            const bool warned = is_warned(result, sensor.sensor.name);
            for (const Reading& r : sensor.readings) tallies[reading++].add(r.estimate, warned);
        }
    }
}

/// Returns whether no reading is wrong too often. Where one is close to that, below or above, four times as
/// many seeds decide.
bool cover(std::string_view name, const Scene& scene, std::span<const Sensor> sensors,
           const RunOptions& options, const RunResult& truth, std::size_t seeds) {
    std::vector<Tally> tallies = tallies_of(truth);
    add_runs(scene, sensors, options, 1, seeds + 1, tallies);
    if (std::ranges::any_of(tallies, &Tally::is_close))
        add_runs(scene, sensors, options, seeds + 1, 4 * seeds + 1, tallies);
    const std::string limit = options.paths ? fmt::format("{} paths", *options.paths)
                                            : fmt::format("error {:g} %", 100 * *options.error);
    const std::string run = fmt::format("{} | {}, {}", name, options.method, limit);
    bool all_hold = true;
    for (Tally& tally : tallies) all_hold = print(run, tally) && all_hold;
    return all_hold;
}

RunResult truth_of(const Scene& scene, std::span<const Sensor> sensors, RunOptions options,
                   std::uint64_t paths) {
    options.seed = kTruthSeed;
    options.paths = paths;
    return run::measure(scene, sensors, options);
}

/// All cases of scene files. Returns whether no reading is wrong too often.
bool cover_files(std::size_t seeds, std::string_view only) {
    bool all_hold = true;
    const Case* before = nullptr;
    RunResult truth;
    for (const Case& of : kCases) {
        if (!only.empty() && only != of.scene) continue;
        const io::SceneFile file = io::read_scene_file(std::filesystem::path(STILB_COVERAGE_SCENES) /
                                                       fmt::format("{}.toml", of.scene));
        if (before == nullptr || before->scene != of.scene)
            truth = truth_of(file.scene, file.sensors, options_of(of.truth_method, 0), of.truth_paths);
        before = &of;
        RunOptions options = options_of(of.method, 0);
        if (of.paths > 0) options.paths = of.paths;
        if (of.error > 0) options.error = of.error;
        all_hold = cover(of.scene, file.scene, file.sensors, options, truth, seeds) && all_hold;
    }
    return all_hold;
}

bool cover_agreement_scene(const AgreementScene& of, std::size_t seeds) {
    const Scene scene = of.make();
    const std::vector<Sensor> sensors = of.sensors();
    RunOptions options = options_of("auto", 0);
    options.bounces = of.bounces;
    const RunResult truth = truth_of(scene, sensors, options, kMillion);
    options.paths = 2048;
    return cover(of.name, scene, sensors, options, truth, seeds);
}

bool is_known(std::string_view name) {
    return std::ranges::any_of(kCases, [&](const Case& of) { return of.scene == name; }) ||
           std::ranges::any_of(agreement_scenes(), [&](const AgreementScene& of) { return of.name == name; });
}

int verify(std::size_t seeds, std::string_view only) {
    if (!only.empty() && !is_known(only)) {
        fmt::print("There is no scene \"{}\".\n", only);
        return 1;
    }
    fmt::print(
        "| scene | run | reading | truth | median ± | holds | warned | wrong without a warning |\n"
        "|---|---|---|---|---|---|---|---|\n");
    bool all_hold = cover_files(seeds, only);
    for (const AgreementScene& of : agreement_scenes()) {
        if (only.empty() || only == of.name) all_hold = cover_agreement_scene(of, seeds) && all_hold;
    }
    return all_hold ? 0 : 1;
}

}  // namespace
}  // namespace stilb

int main(int count, char** arguments) {
    const std::size_t seeds = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 400;
    return stilb::verify(seeds, count > 2 ? arguments[2] : "");
}
