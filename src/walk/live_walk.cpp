#include "walk/live_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/monitor.h"
#include "io/results/results_text.h"
#include "rays/ray_caster.h"

namespace stilb::walk {
namespace {

/// As often as a walker notices.
constexpr std::chrono::milliseconds kLeastPause{400};
/// The pause after light was shown, as a multiple of the time that showing it took.
constexpr int kPauses = 9;

/// The share that is done of a run with a limit.
double share_done(const ProgressSink::Progress& progress) {
    if (!std::isfinite(progress.remaining_s)) return 0;
    const double all_s = progress.elapsed_s + progress.remaining_s;
    return all_s > 0 ? progress.elapsed_s / all_s : 0;
}

}  // namespace

void Pace::add(Clock::time_point begin, Clock::time_point end) {
    next_ = end + std::max<Clock::duration>(kPauses * (end - begin), kLeastPause);
}

LiveWalk::LiveWalk(const io::SceneFile& file, const RunOptions& options, int degree, ProgressSink* progress)
    : file_(file), options_(options), degree_(degree), progress_(progress) {}

LiveWalk::LiveWalk(const io::SceneFile& file, SolveResult solved)
    : file_(file), result_(std::move(solved)), is_solved_(true) {}

LiveWalk::~LiveWalk() {
    interrupt();
    if (thread_.joinable()) thread_.join();
}

void LiveWalk::start() {
    begin_ = Pace::Clock::now();
    thread_ = std::thread([this] { work(); });
}

SolveResult LiveWalk::finish() {
    thread_.join();
    if (failure_) std::rethrow_exception(failure_);
    return std::move(*result_);
}

double LiveWalk::elapsed_s() const {
    return std::chrono::duration<double>(Pace::Clock::now() - begin_).count();
}

void LiveWalk::work() {
    try {
        is_solved_ ? show_solved() : solve();
        change([&](State& state) {
            state.stage = "done";
            state.share = 1;
            state.is_done = true;
            state.message = fmt::format("Finished: {}.", io::ending(result_->stop_reason, "steps"));
        });
    } catch (...) {
        failure_ = std::current_exception();
    }
    is_finished_ = true;
}

void LiveWalk::solve() {
    result_ = run::solve(file_.scene, options_, degree_, this, &is_interrupted_, this);
    make_light(result_->solution, *result_);
}

void LiveWalk::show_solved() {
    const rays::RayCaster caster(file_.scene);
    make_scene(caster, result_->solution);
    make_light(result_->solution, *result_);
}

void LiveWalk::make_scene(const rays::RayCaster& caster, const estimators::PatchSolution& solution) {
    const Monitor monitor(&is_interrupted_, std::nullopt, [this](std::string_view stage, double share) {
        report_set_up({stage, share, elapsed_s()});
    });
    const std::string name = file_.sources.empty() ? "" : file_.sources.front().filename().string();
    auto bytes = std::make_shared<const std::string>(
        scene_data(file_.scene, caster, solution, {file_.scene.name, name, file_.sensors}, monitor));
    const std::lock_guard lock(mutex_);
    scene_ = std::move(bytes);
}

void LiveWalk::make_light(const estimators::PatchSolution& solution, const RunSummary& summary) {
    // Only the thread that works changes the version.
    const LightState state{.version = state_.light + 1,
                           .steps = summary.samples,
                           .error = summary.attained_error,
                           .elapsed_s = summary.elapsed_s,
                           .done = result_.has_value()};
    auto bytes = std::make_shared<const std::string>(light_data(solution, state));
    const std::lock_guard lock(mutex_);
    light_ = std::move(bytes);
    state_.light = state.version;
    state_.error = state.error;
    state_.elapsed_s = state.elapsed_s;
}

void LiveWalk::change(const std::function<void(State&)>& change) {
    const std::lock_guard lock(mutex_);
    change(state_);
}

void LiveWalk::prepare(const rays::RayCaster& caster, const estimators::PatchSolution& dark) {
    make_scene(caster, dark);
}

bool LiveWalk::wants_solution() {
    wanted_ = Pace::Clock::now();
    return pace_.is_due(wanted_);
}

void LiveWalk::show(const estimators::PatchSolution& solution, const RunSummary& so_far) {
    RunSummary summary = so_far;
    summary.elapsed_s = elapsed_s();
    make_light(solution, summary);
    // The time since the light was asked for counts, too: the run made a solution for it.
    pace_.add(wanted_, Pace::Clock::now());
}

void LiveWalk::report_set_up(const SetUp& set_up) {
    change([&](State& state) {
        state.stage = set_up.stage;
        state.share = set_up.share;
        state.elapsed_s = set_up.elapsed_s;
    });
    if (progress_) progress_->report_set_up(set_up);
}

void LiveWalk::report(const Progress& progress) {
    change([&](State& state) {
        state.stage = "refining";
        state.share = share_done(progress);
        state.elapsed_s = progress.elapsed_s;
    });
    if (progress_) progress_->report(progress);
}

Bytes LiveWalk::scene() const {
    const std::lock_guard lock(mutex_);
    return scene_;
}

Bytes LiveWalk::light() const {
    const std::lock_guard lock(mutex_);
    return light_;
}

std::string LiveWalk::state() const {
    const std::lock_guard lock(mutex_);
    // An error that is not known is null.
    const nlohmann::ordered_json error =
        state_.light == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(state_.error);
    return nlohmann::ordered_json{
        {"stage", state_.stage},  {"share", state_.share},    {"scene", scene_ != nullptr},
        {"light", state_.light},  {"error", error},           {"elapsed_s", state_.elapsed_s},
        {"done", state_.is_done}, {"message", state_.message}}
        .dump();
}

}  // namespace stilb::walk
