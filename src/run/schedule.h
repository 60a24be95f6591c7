// What runs of all kinds have in common: the ray caster, the threads and the watch over the set-up, and the
// schedule, which advances some work until a rule says stop.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/monitor.h"
#include "base/parallel.h"
#include "estimators/estimator.h"
#include "run/options.h"
#include "run/result.h"
#include "run/run.h"

namespace stilb::run {

/// Time since it was made.
class Clock {
  public:
    double elapsed_s() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What grows sample by sample: readings, a picture or a solution.
class Work {
  public:
    virtual ~Work() = default;

    /// Of each replicate, or of the picture.
    virtual std::uint64_t samples() const = 0;
    /// Of all replicates, as RunSummary has them.
    virtual std::uint64_t samples_in_all() const = 0;
    /// So many samples are made where the user asks for `paths` in all.
    virtual std::uint64_t samples_for(std::uint64_t paths) const = 0;
    /// There are never more.
    virtual std::uint64_t most_samples() const = 0;
    /// There is no result with fewer: so many are made whatever the clock and the user say.
    virtual std::uint64_t least_samples() const { return 1; }
    /// After how many to look at the error next.
    virtual std::uint64_t next_look() const = 0;
    /// Between two looks at the clock.
    virtual std::uint64_t most_at_once() const = 0;

    /// Makes the next `count` samples. False where `interrupt` (which may be null) stopped it: then nothing
    /// is added.
    virtual bool advance(std::uint64_t count, const std::atomic<bool>* interrupt) = 0;
    virtual double attained_error() const = 0;
    /// Called after each report of progress: shows the result so far to whom it may concern.
    virtual void show() {}
};

/// The rules by which a run ends.
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
    Ending run(Work& work) const;

  private:
    /// A stretch of work whose end is a look at the error; a reason where it got no farther.
    std::optional<StopReason> advance_to(std::uint64_t look, std::uint64_t last, Work& work,
                                         double& error) const;
    bool is_time_over(const Work& work, std::uint64_t next) const;
    void report(const Work& work, std::uint64_t last, double error) const;

    const RunOptions& options_;
    const Clock& clock_;
    ProgressSink* sink_;
    const std::atomic<bool>* interrupt_;
};

/// Seconds until the first of the targets is met, infinite without any: the error falls as the root of time,
/// samples take alike. `attained_error` may be infinite, `share_done` is that of the paths asked for.
double remaining_time_s(const RunOptions& options, double elapsed_s, double attained_error,
                        double share_done);

/// One run from its beginning. The time that the user asks for holds for the set-up too; a default does not.
class Session {
  public:
    /// `asked` are the user's options, `options` those with defaults.
    Session(const Scene& scene, const RunOptions& asked, const RunOptions& options, ProgressSink* sink,
            const std::atomic<bool>* interrupt);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const rays::RayCaster& caster() const { return caster_; }
    const Monitor& monitor() const { return monitor_; }
    /// Without measurands and camera.
    estimators::Problem problem(math::RandomKey preparation_key) const;

    /// Calls `action` where its parallel loops take as many threads as the user asks for.
    void on_threads(const std::function<void()>& action) { pool_.execute(action); }

    /// Advances the work until a rule says stop: sets samples, stop_reason, converged and attained_error.
    void run(Work& work, RunSummary& summary);
    /// Sets what else all results have: what the estimator tells, and the time.
    void describe(const estimators::Estimator& estimator, RunSummary& summary) const;
    void finish(RunSummary& summary) const;

  private:
    Clock clock_;
    const Scene& scene_;
    RunOptions options_;
    ProgressSink* sink_;
    const std::atomic<bool>* interrupt_;
    Monitor monitor_;
    rays::RayCaster caster_;
    ThreadPool pool_;
};

}  // namespace stilb::run
