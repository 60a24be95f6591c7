// A walk through light that is still being computed: a thread solves, others take what is there.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "io/scene/scene_file.h"
#include "run/solve.h"
#include "walk/data/walk_data.h"
#include "walk/service/server.h"

namespace stilb::walk {

/// Decides when unfinished light is shown: so that this takes a tenth of the time at most.
class Pace {
  public:
    using Clock = std::chrono::steady_clock;

    bool is_due(Clock::time_point now) const { return now >= next_; }
    /// Light was shown between the two times.
    void add(Clock::time_point begin, Clock::time_point end);

  private:
    Clock::time_point next_{};
};

/// The light of a scene from its beginning, or that of a solution, as data for the page.
class LiveWalk final : private SolutionSink, private ProgressSink {
  public:
    /// Solves the scene. `progress` receives the run's reports and may be null. File and sink must outlive
    /// this.
    LiveWalk(const io::SceneFile& file, const RunOptions& options, int degree, ProgressSink* progress);
    /// Shows what was solved before.
    LiveWalk(const io::SceneFile& file, SolveResult solved);
    /// Interrupts the work, and waits for its end.
    ~LiveWalk() override;
    LiveWalk(const LiveWalk&) = delete;
    LiveWalk& operator=(const LiveWalk&) = delete;

    /// Begins the work in a thread of its own.
    void start();
    void interrupt() { is_interrupted_ = true; }
    bool is_finished() const { return is_finished_; }
    /// Waits for the end and gives the result. Throws what the work threw. Once only.
    SolveResult finish();

    // From any thread, at any time.

    /// The containers, as walk_data.h makes them; null: not there yet.
    Bytes scene() const;
    Bytes light() const;
    /// The answer to "GET state", as docs/walk.md describes it.
    std::string state() const;

  private:
    struct State {
        std::string stage = "reading", message;
        double share = 0, error = 0, elapsed_s = 0;
        int light = 0;
        bool is_done = false;
    };

    double elapsed_s() const;
    void work();
    void solve();
    void show_solved();
    void make_scene(const rays::RayCaster& caster, const estimators::PatchSolution& solution);
    void make_light(const estimators::PatchSolution& solution, const RunSummary& summary);
    void change(const std::function<void(State&)>& change);

    // The run calls these from its threads.
    void prepare(const rays::RayCaster& caster, const estimators::PatchSolution& dark) override;
    bool wants_solution() override;
    void show(const estimators::PatchSolution& solution, const RunSummary& so_far) override;
    void report_set_up(const SetUp& set_up) override;
    void report(const Progress& progress) override;

    const io::SceneFile& file_;
    RunOptions options_;
    int degree_ = 0;
    ProgressSink* progress_ = nullptr;
    std::optional<SolveResult> result_;
    bool is_solved_ = false;  ///< from the beginning
    Pace pace_;
    Pace::Clock::time_point begin_, wanted_;
    std::atomic<bool> is_interrupted_ = false, is_finished_ = false;
    std::exception_ptr failure_;

    mutable std::mutex mutex_;  ///< of the following
    State state_;
    Bytes scene_, light_;

    std::thread thread_;
};

}  // namespace stilb::walk
