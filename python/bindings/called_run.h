// Runs of the library, called from Python: other Python threads go on meanwhile, progress is reported, and
// Ctrl-C ends them.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "stilb/options.h"

namespace stilb::api::bindings {

/// Lets a run report to its caller, and the caller end the run. The run has a thread of its own, because
/// Python handles signals in the thread that called it.
class CalledRun {
  public:
    /// `progress`: a function that gets a Progress, or None. The run ends early, with its result so far,
    /// where the function returns False.
    explicit CalledRun(nanobind::object progress) : progress_(std::move(progress)) {}

    /// Returns the result of run(control), and throws what it or the function of progress throws;
    /// KeyboardInterrupt after Ctrl-C. Exceptions of the caller have the run's result so far as their
    /// attribute `result`, None where there is none yet.
    template <typename Run>
    auto operator()(const Run& run) {
        const Control control{[this](const Progress& progress) { report(progress); }, &interrupt_};
        std::optional<decltype(run(control))> result;
        {
            const nanobind::gil_scoped_release release;
            std::thread thread([&] {
                try {
                    result.emplace(run(control));
                } catch (...) {
                    error_ = std::current_exception();
                }
                finish();
            });
            wait();
            thread.join();
        }
        if (caller_error_) throw_with(result ? nanobind::cast(std::move(*result)) : nanobind::none());
        if (error_) std::rethrow_exception(error_);
        return std::move(*result);
    }

  private:
    void report(const Progress& progress);
    void finish();
    void wait();
    /// Handles signals and calls the function of progress.
    void attend(const std::optional<Progress>& progress);
    /// Throws the caller's exception, with the result.
    [[noreturn]] void throw_with(const nanobind::object& result) const;

    nanobind::object progress_;
    std::atomic<bool> interrupt_ = false;
    std::mutex mutex_;
    std::condition_variable finished_;
    bool is_finished_ = false;
    std::optional<Progress> latest_;
    std::exception_ptr error_, caller_error_;
};

}  // namespace stilb::api::bindings
