// Work of each technique to a relative standard error of 1 %, in ten scenes, by counted rays: no clock, so
// that any machine can compare with the figures of the repository (baseline.csv).
//
//     bench_techniques [--baseline FILE] [--write FILE] [--seed N] [SCENE ...]
//
// Work is the rays of many rounds, times the square of the relative standard error of their mean, in units of
// 1 %: the error of a reading or pixel on average, without the worst 5 %. With a baseline, the exit code is 1
// where the work or the rays of the set-up differ from it by more than a tenth (and the work by more than its
// noise): if it is less, write a new baseline. What techniques compute without rays is not counted:
// bench_efficiency and bench-peers have a clock.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "efficiency.h"
#include "estimators/estimator_list.h"
#include "io/scene/scene_file.h"
#include "io/text/table.h"
#include "rays/ray_caster.h"
#include "statistics/interval.h"
#include "support/source_directory.h"
#include "transport/receiver.h"

namespace stilb {
namespace {

struct Case {
    std::string_view name, file;
    /// The sensor of the scene; a plane 0.8 m above its floor if there is none.
    std::string_view grid = "grid";
};
constexpr std::array<Case, 10> kCases{{
    {"room", "benchmarks/peers/scenes/room.toml"},
    {"cube", "benchmarks/peers/scenes/cube.toml"},
    {"office", "scenes/office/office.toml", "desk_a"},
    {"hall", "benchmarks/peers/scenes/hall.toml"},
    {"door", "benchmarks/peers/scenes/door.toml"},
    {"showroom", "benchmarks/peers/scenes/showroom.toml", "sixteen"},
    {"classroom", "scenes/classroom/classroom.toml", "task"},
    {"attic", "benchmarks/techniques/attic.toml"},
    {"window-room", "benchmarks/techniques/window_room.toml"},
    {"furnished", "scenes/paper/furnished.toml", ""},
}};
constexpr std::array<std::string_view, 3> kTechniques{"path", "light-paths", "guided"};

/// So many set-ups, each with so many rounds: plans that were made of few rays differ.
constexpr std::uint64_t kSetUps = 8, kRounds = 32, kPictureRounds = 16;
constexpr int kMostCells = 8, kColumns = 32;
/// Samples of a round of `path`, whose batches may have any number.
constexpr std::uint64_t kLeastSamples = 64;
/// Differences of work that count, where they are also so many times their own standard error: light that
/// few samples find makes the error uncertain.
constexpr double kTolerance = 0.1, kStandardErrors = 4;

struct Work {
    double set_up = 0;  ///< [rays]
    double work = 0;    ///< [rays to 1 %]
    double noise = 0;   ///< the relative standard error of `work`
};
using Table = std::map<std::string, Work>;

/// The rays of what `action` does.
template <typename Action>
double rays_of(const Action& action) {
    const std::uint64_t before = rays::traced_rays();
    action();
    return static_cast<double>(rays::traced_rays() - before);
}

/// The samples of a round: as many as a run takes before its first error estimate.
std::uint64_t samples_of_a_round(const estimators::Estimator& estimator) {
    const std::uint64_t unit = estimator.batch_granularity();
    return std::max(estimator.first_check(), (kLeastSamples + unit - 1) / unit * unit);
}

/// The mean relative standard error of the readings, without the worst 5 %: a run stops by the others.
double error_of(const statistics::ReplicateTable& rounds) {
    std::vector<double> means, errors;
    const std::vector<statistics::Estimate> estimates = statistics::estimate_readings(rounds);
    for (const statistics::Estimate& estimate : estimates) means.push_back(estimate.value);
    const double dark = statistics::dark_level(means);
    for (const statistics::Estimate& e : estimates)
        errors.push_back(e.standard_error / std::max(e.value, dark));
    std::ranges::sort(errors);
    errors.resize((errors.size() * 95 + 99) / 100);
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

/// The work for the readings of a problem, or for its picture.
Work work_of(estimators::Problem problem, const estimators::EstimatorEntry& technique, math::RandomKey key) {
    const std::uint64_t rounds = problem.camera ? kPictureRounds : kRounds;
    std::vector<double> set_ups, works;
    for (std::uint64_t i = 0; i < kSetUps; ++i) {
        const math::RandomKey own = key.derived(i);
        problem.preparation_key = {own.derived(rounds)};
        std::unique_ptr<estimators::Estimator> estimator;
        set_ups.push_back(rays_of([&] { estimator = technique.make(problem); }));
        const Measure measure = problem.camera ? picture_with(*estimator, problem.camera->resolution, own)
                                               : readings_with(*estimator, own);
        const std::uint64_t samples = problem.camera ? 1 : samples_of_a_round(*estimator);
        std::vector<double> values;
        const double sampling = rays_of([&] {
            for (std::uint64_t round = 0; round < rounds; ++round)
                std::ranges::copy(measure(round, samples), std::back_inserter(values));
        });
        const double error = error_of({values, values.size() / rounds});
        works.push_back(sampling * error * error / 1e-4);
    }
    const statistics::Estimate work = statistics::estimate_from_replicates(works);
    return {statistics::estimate_from_replicates(set_ups).value, work.value,
            work.standard_error / work.value};
}

/// A plane at the height of desks, for scenes that have none.
Sensor plane_in(const Scene& scene) {
    const Bounds bounds = bounds_of(scene);
    const Vec3 size = bounds.max - bounds.min;
    return {"grid", Grid{bounds.min + Vec3{0.05 * size.x, 0.05 * size.y, 0.8},
                         {0.9 * size.x, 0, 0},
                         {0, 0.9 * size.y, 0},
                         {kMostCells, kMostCells}}};
}

std::vector<Measurand> readings_of(const io::SceneFile& file, const Case& chosen) {
    if (chosen.grid.empty()) return plane_in(file.scene).measurands();
    Sensor sensor = *std::ranges::find(file.sensors, chosen.grid, &Sensor::name);
    if (auto* const grid = std::get_if<Grid>(&sensor.kind)) {
        for (int& count : grid->count) count = std::min(count, kMostCells);
    }
    return sensor.measurands();
}

std::optional<Camera> camera_of(const io::SceneFile& file) {
    for (const Sensor& sensor : file.sensors) {
        if (!sensor.camera()) continue;
        Camera camera = *sensor.camera();
        camera.resolution = {kColumns, kColumns * camera.resolution[1] / camera.resolution[0]};
        return camera;
    }
    return std::nullopt;
}

/// Adds the rows of a scene.
void measure(const Case& chosen, math::RandomKey key, Table& table) {
    const io::SceneFile file = io::read_scene_file(source_directory() / chosen.file);
    const rays::RayCaster caster(file.scene);
    const std::vector<Measurand> readings = readings_of(file, chosen);
    const std::optional<Camera> camera = camera_of(file);
    for (const std::string_view name : kTechniques) {
        const estimators::EstimatorEntry& technique = estimators::find_estimator(name);
        estimators::Problem problem{.scene = file.scene,
                                    .caster = caster,
                                    .max_reflections = transport::kUnlimited,
                                    .preparation_key = key,
                                    .measurands = readings};
        table[fmt::format("{},readings,{}", chosen.name, name)] = work_of(problem, technique, key);
        if (!camera) continue;
        problem.measurands = {};
        problem.camera = camera;
        table[fmt::format("{},picture,{}", chosen.name, name)] = work_of(problem, technique, key);
    }
}

constexpr std::string_view kHead = "scene,what,technique,set-up [rays],work [rays to 1 %],noise";

Table read_table(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line) || line != kHead)
        throw std::runtime_error(fmt::format("{}: is no baseline, whose first line is \"{}\".", path, kHead));
    Table table;
    while (std::getline(file, line)) {
        std::array<std::string, 6> cells;
        std::istringstream row(line);
        for (std::string& cell : cells) std::getline(row, cell, ',');
        table[fmt::format("{},{},{}", cells[0], cells[1], cells[2])] = {
            std::stod(cells[3]), std::stod(cells[4]), std::stod(cells[5])};
    }
    return table;
}

std::string text_of(const Table& table) {
    std::string text = fmt::format("{}\n", kHead);
    for (const auto& [row, work] : table)
        text += fmt::format("{},{:.0f},{:.4g},{:.2g}\n", row, work.set_up, work.work, work.noise);
    return text;
}

/// Prints a row with what it is of the baseline; whether both agree.
bool agrees(const std::string& row, const Work& now, const Table& baseline) {
    fmt::print("{:32} {:10.4g} {:10.4g} {:5.1f} %", row, now.set_up, now.work, 100 * now.noise);
    const auto found = baseline.find(row);
    bool agrees = false;
    if (found == baseline.end()) {
        fmt::print("   not in the baseline\n");
    } else {
        const Work& before = found->second;
        const double tolerance = std::max(kTolerance, kStandardErrors * std::hypot(now.noise, before.noise));
        const double work = now.work / before.work;
        const double set_up = now.set_up == before.set_up ? 1 : now.set_up / before.set_up;
        agrees = std::abs(work - 1) <= tolerance && std::abs(set_up - 1) <= kTolerance;
        fmt::print("   set-up x {:.3f}, work x {:.3f}{}\n", set_up, work, agrees ? "" : "  DIFFERS");
    }
    std::fflush(stdout);
    return agrees;
}

struct Request {
    std::string baseline, output;
    std::uint64_t seed = 1;
    std::vector<Case> cases;
};

std::string names_of_cases() {
    std::vector<std::string_view> names;
    for (const Case& each : kCases) names.push_back(each.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

Request read_request(std::span<const std::string> words) {
    Request request;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto value = [&] {
            if (++i == words.size()) throw std::runtime_error(words.back() + " needs a value");
            return words[i];
        };
        const auto* const found = std::ranges::find(kCases, words[i], &Case::name);
        if (found != kCases.end())
            request.cases.push_back(*found);
        else if (words[i] == "--baseline")
            request.baseline = value();
        else if (words[i] == "--write")
            request.output = value();
        else if (words[i] == "--seed")
            request.seed = std::stoull(value());
        else
            throw std::runtime_error(
                fmt::format("\"{}\" is no scene and no option. Allowed: {}, --baseline FILE, "
                            "--write FILE, --seed N.",
                            words[i], names_of_cases()));
    }
    if (request.cases.empty()) request.cases.assign(kCases.begin(), kCases.end());
    return request;
}

int compare(const Request& request) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const Table baseline = request.baseline.empty() ? Table{} : read_table(request.baseline);
    fmt::print("{:32} {:>10} {:>10} {:>7}\n", "", "set-up", "work", "noise");
    Table all;
    bool all_agree = true;
    for (const Case& chosen : request.cases) {
        Table rows;
        measure(chosen, math::RandomKey{request.seed}, rows);
        for (const auto& [row, work] : rows) all_agree = agrees(row, work, baseline) && all_agree;
        all.merge(rows);
    }
    if (!request.output.empty()) io::replace_file(request.output, text_of(all));
    return request.baseline.empty() || all_agree ? 0 : 1;
}

}  // namespace
}  // namespace stilb

int main(int count, char** words) {
    try {
        return stilb::compare(stilb::read_request(std::vector<std::string>(words + 1, words + count)));
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_techniques: {}\n", error.what());
        return 2;
    }
}
