#include "run/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "checks/checks.h"
#include "stilb/error.h"
#include "transport/receiver.h"

namespace stilb::run {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::optional<Monitor::Clock::time_point> deadline_of(const RunOptions& asked) {
    if (!asked.time_s) return std::nullopt;
    // Durations beyond the range of the clock count as unlimited.
    constexpr double longest_s = 1e9;
    const std::chrono::duration<double> time(std::min(*asked.time_s - asked.reserved_s, longest_s));
    return Monitor::Clock::now() + std::chrono::duration_cast<Monitor::Clock::duration>(time);
}

/// Why samples end before the time limit, where a user would notice.
std::string reserve_text(double reserved_s) {
    constexpr double noticeable_s = 0.1;
    if (reserved_s < noticeable_s) return "";
    return fmt::format(" ({:.1f} s are for writing the result)", reserved_s);
}

Monitor::Report report_to(ProgressSink* sink, const Clock& clock) {
    if (!sink) return {};
    return [sink, &clock](std::string_view stage, double share) {
        sink->report_set_up({stage, share, clock.elapsed_s()});
    };
}

}  // namespace

Schedule::Ending Schedule::run(Work& work) {
    samples_before_ = work.samples();
    const std::uint64_t last = options_.paths ? work.samples_for(*options_.paths) : work.most_samples();
    double error = work.is_at_check() ? work.attained_error() : kInfinity;
    if (work.is_at_check() || work.samples() >= last) {
        if (const auto reason = reason_at_check(work, last, error)) return {*reason, work.attained_error()};
    }
    for (;;) {
        const std::uint64_t check = std::min(last, work.next_check());
        if (const auto reason = advance_to(check, last, work, error)) return {*reason, work.attained_error()};
        if (const auto reason = reason_at_check(work, last, error)) return {*reason, error};
        if (options_.stops_at_check) return {StopReason::interrupted, error};
    }
}

std::optional<StopReason> Schedule::reason_at_check(const Work& work, std::uint64_t last,
                                                    double error) const {
    if (options_.error && error <= *options_.error) return StopReason::target_reached;
    if (ends_when_decided(options_) && work.is_decided()) return StopReason::requirements_decided;
    if (options_.error && work.is_beyond_reach(*options_.error)) return StopReason::patches_too_coarse;
    if (work.samples() >= last) return StopReason::paths_done;
    return std::nullopt;
}

std::optional<StopReason> Schedule::advance_to(std::uint64_t check, std::uint64_t last, Work& work,
                                               double& error) const {
    while (work.samples() < check) {
        const std::uint64_t next = std::min(work.most_at_once(), check - work.samples());
        if (work.has_result() && is_time_over(work, next)) return StopReason::time_over;
        if (const auto reason = advance(next, work)) return reason;
        if (work.samples() == check) error = work.attained_error();
        report(work, last, error);
        work.show();
    }
    return std::nullopt;
}

std::optional<StopReason> Schedule::advance(std::uint64_t count, Work& work) const {
    const auto is_interrupted = [&] { return interrupt_ && *interrupt_; };
    try {
        if (!is_interrupted()) work.advance(count);
    } catch (const Cancelled&) {
        if (!work.has_result() && !is_interrupted()) {
            throw Cancelled(fmt::format(
                "time limit reached after {:.2g} s{}, before the first result: there is no result "
                "yet. Allow more time, or reduce the work: fewer readings or pixels, larger "
                "patches.",
                clock_.elapsed_s(), reserve_text(options_.reserved_s)));
        }
        if (!is_interrupted()) return StopReason::time_over;
    }
    if (!is_interrupted()) return std::nullopt;
    if (work.has_result()) return StopReason::interrupted;
    throw Cancelled(fmt::format("interrupted after {:.2g} s, before the first result: there is no result yet",
                                clock_.elapsed_s()));
}

/// Predicts whether the next samples end in time, if they take as long as the last ones.
bool Schedule::is_time_over(const Work& work, std::uint64_t next) const {
    const std::uint64_t own = work.samples() - samples_before_;
    if (!options_.time_s || own == 0) return false;
    const double per_sample_s = begun_.elapsed_s() / static_cast<double>(own);
    const double end_s = clock_.elapsed_s() + per_sample_s * static_cast<double>(next);
    return end_s > *options_.time_s - options_.reserved_s;
}

void Schedule::report(const Work& work, std::uint64_t last, double error) const {
    if (!sink_) return;
    const double elapsed_s = clock_.elapsed_s();
    const double done = static_cast<double>(work.samples()) / static_cast<double>(last);
    sink_->report(
        {elapsed_s, remaining_time_s(options_, elapsed_s, error, done), error, work.samples_in_all()});
}

double remaining_time_s(const RunOptions& options, double elapsed_s, double attained_error,
                        double share_done) {
    double remaining_s = kInfinity;
    if (options.error) {
        const double ratio = attained_error / *options.error;
        remaining_s = std::min(remaining_s, elapsed_s * std::max(0.0, ratio * ratio - 1));
    }
    if (options.time_s) remaining_s = std::min(remaining_s, std::max(0.0, *options.time_s - elapsed_s));
    if (options.paths) remaining_s = std::min(remaining_s, elapsed_s * (1 / share_done - 1));
    return remaining_s;
}

void require_mostly_finite(std::uint64_t invalid, double all) {
    constexpr double tolerated = 1e-6;
    if (static_cast<double>(invalid) <= tolerated * all) return;
    throw std::runtime_error(fmt::format(
        "{} of {} samples are not finite: this is a defect of Stilb, please report the scene", invalid, all));
}

Session::Session(const PreparedScene& scene, std::span<const Sensor> sensors, const RunOptions& asked,
                 const RunOptions& options, ProgressSink* sink, const std::atomic<bool>* interrupt)
    : prepared_(scene),
      options_(options),
      sink_(sink),
      interrupt_(interrupt),
      monitor_(interrupt, deadline_of(asked), report_to(sink, clock_)),
      caster_(prepared_.caster(sensors::measured_points(sensors), monitor_)),
      pool_(options.threads) {}

const checks::Enclosures& Session::enclosures() {
    if (!enclosures_) enclosures_.emplace(scene(), caster(), prepared_.findings());
    return *enclosures_;
}

std::vector<Sensor> Session::without_hidden_points(std::span<const Sensor> sensors) {
    const auto is_area = [](const Sensor& sensor) { return std::holds_alternative<Area>(sensor.kind); };
    if (std::ranges::none_of(sensors, is_area)) return {sensors.begin(), sensors.end()};
    return checks::without_hidden_points(scene(), caster(), enclosures(), sensors);
}

std::vector<Warning> Session::scene_warnings(std::span<const Sensor> sensors) {
    monitor_.report("checks", 0);
    if (!options_.bounces) {
        if (const auto endless = checks::endless_light(scene(), caster())) throw InputError(*endless);
    }
    if (options_.checks == Checks::refusals) return {};
    return checks::scene_warnings(scene(), caster(), enclosures(), sensors);
}

estimators::Problem Session::problem() const {
    return {.scene = scene(),
            .caster = caster(),
            .max_reflections = options_.bounces.value_or(transport::kUnlimited),
            .patches = {options_.patches, options_.patch_m},
            .monitor = monitor_};
}

void Session::run(Work& work, RunSummary& summary) {
    const Schedule::Ending ending = Schedule(options_, clock_, sink_, interrupt_).run(work);
    summary.samples = work.samples_in_all();
    summary.stop_reason = ending.reason;
    summary.attained_error = ending.attained_error;
    summary.requested_error = options_.error;
    summary.converged = ending.reason != StopReason::interrupted &&
                        (!options_.error || ending.attained_error <= *options_.error);
}

void Session::describe(const estimators::Estimator& estimator, RunSummary& summary) const {
    summary.technique = estimator.technique();
    summary.patches = estimator.patch_report();
    add_warnings(WarningKind::method, estimator.warnings(), summary.warnings);
}

void Session::finish(RunSummary& summary) const {
    summary.method = options_.method;
    summary.seed = options_.seed;
    summary.elapsed_s = clock_.elapsed_s();
    summary.maintenance = scene::maintenance_factors(scene());
}

}  // namespace stilb::run
