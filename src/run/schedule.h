// The common part of all kinds of runs: the ray caster, the threads and the monitor of the set-up, and the
// schedule, which advances the work until a rule says stop.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "base/monitor.h"
#include "base/parallel.h"
#include "base/warning.h"
#include "checks/checks.h"
#include "estimators/estimator.h"
#include "run/options.h"
#include "run/prepared_scene.h"
#include "run/result.h"
#include "run/run.h"

namespace stilb::run {

/// Time since its construction.
class Clock {
  public:
    double elapsed_s() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Work that grows sample by sample: readings, a picture or a solution.
class Work {
  public:
    virtual ~Work() = default;

    /// The samples of each replicate, or of the picture.
    virtual std::uint64_t samples() const = 0;
    /// The samples of all replicates, as in RunSummary.
    virtual std::uint64_t samples_in_all() const = 0;
    /// The number of samples for the user's `paths`.
    virtual std::uint64_t samples_for(std::uint64_t paths) const = 0;
    /// The largest number of samples.
    virtual std::uint64_t most_samples() const = 0;
    /// Whether there are enough samples for a result with an error.
    virtual bool has_result() const = 0;
    /// The number of samples at the next error estimate.
    virtual std::uint64_t next_check() const = 0;
    /// Whether work that goes on has got to an error estimate, which its run may have made.
    virtual bool is_at_check() const { return false; }
    /// Samples between two checks of the clock.
    virtual std::uint64_t most_at_once() const = 0;

    /// Makes the next `count` samples. Throws Cancelled where the monitor ends the run, with the samples that
    /// are done by then: they may be fewer in some replicates.
    virtual void advance(std::uint64_t count) = 0;
    virtual double attained_error() const = 0;
    /// Whether there are requirements, and all of them are decided.
    virtual bool is_decided() const { return false; }
    /// Whether no number of samples reaches this error.
    virtual bool is_beyond_reach(double /*error*/) const { return false; }
    /// Called after each report of progress: shows the unfinished result where the sink asks for it.
    virtual void show() {}
};

/// The rules that end a run. The work is begun when the schedule is made.
class Schedule {
  public:
    /// `sink` and `interrupt` may be null.
    Schedule(const RunOptions& options, const Clock& clock, ProgressSink* sink,
             const std::atomic<bool>* interrupt)
        : options_(options), clock_(clock), sink_(sink), interrupt_(interrupt) {}

    struct Ending {
        StopReason reason = StopReason::paths_done;
        double attained_error = 0;
    };
    Ending run(Work& work);

  private:
    /// The reason to end at an error estimate, if there is one; `last` samples are the most.
    std::optional<StopReason> reason_at_check(const Work& work, std::uint64_t last, double error) const;
    /// Advances to the next error estimate; returns a reason where the run ends before.
    std::optional<StopReason> advance_to(std::uint64_t check, std::uint64_t last, Work& work,
                                         double& error) const;
    /// Advances by `count` samples; returns a reason where the run ends before. Throws Cancelled where there
    /// is no result then.
    std::optional<StopReason> advance(std::uint64_t count, Work& work) const;
    bool is_time_over(const Work& work, std::uint64_t next) const;
    void report(const Work& work, std::uint64_t last, double error) const;

    const RunOptions& options_;
    const Clock& clock_;
    Clock begun_;
    std::uint64_t samples_before_ = 0;  ///< of the work, before this run of it
    ProgressSink* sink_;
    const std::atomic<bool>* interrupt_;
};

/// Seconds until the first of the limits is met, infinite without any: the error falls as the square root of
/// time, all samples take the same time. `attained_error` may be infinite, `share_done` is that of the
/// requested paths.
double remaining_time_s(const RunOptions& options, double elapsed_s, double attained_error,
                        double share_done);

/// Throws std::runtime_error where more than one sample in a million is not finite. These are left out.
void require_mostly_finite(std::uint64_t invalid, double all);

/// One run from its beginning. The user's time limit includes the set-up; a default one does not.
class Session {
  public:
    /// `sensors`: those that are measured, or none. `asked` are the user's options, `options` those with
    /// defaults.
    Session(const PreparedScene& scene, std::span<const Sensor> sensors, const RunOptions& asked,
            const RunOptions& options, ProgressSink* sink, const std::atomic<bool>* interrupt);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const rays::RayCaster& caster() const { return *caster_; }
    const Monitor& monitor() const { return monitor_; }
    /// As checks::without_hidden_points().
    std::vector<Sensor> without_hidden_points(std::span<const Sensor> sensors);
    /// The warnings of all checks (checks/checks.h), unless the options do without. They belong before the
    /// samples: so they count in the time limit. Throws InputError where light finds no end.
    std::vector<Warning> scene_warnings(std::span<const Sensor> sensors);
    /// The problem without measurands and camera.
    estimators::Problem problem() const;

    /// Calls `action` with the user's number of threads for its parallel loops.
    void on_threads(const std::function<void()>& action) { pool_.execute(action); }

    /// Advances the work until a rule ends it: sets samples, stop_reason, converged and attained_error.
    void run(Work& work, RunSummary& summary);
    /// Sets the other common fields of results: the estimator's reports, and the time.
    void describe(const estimators::Estimator& estimator, RunSummary& summary) const;
    void finish(RunSummary& summary) const;

  private:
    const Scene& scene() const { return prepared_.scene(); }
    const checks::Enclosures& enclosures();

    Clock clock_;
    const PreparedScene& prepared_;
    RunOptions options_;
    ProgressSink* sink_;
    const std::atomic<bool>* interrupt_;
    Monitor monitor_;
    std::shared_ptr<const rays::RayCaster> caster_;
    std::optional<checks::Enclosures> enclosures_;
    ThreadPool pool_;
};

}  // namespace stilb::run
