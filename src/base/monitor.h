// Progress and cancellation of work.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "stilb/error.h"

namespace stilb {

/// Takes reports from any thread, and passes on one at a time, some ten in a second. Must outlive
/// its users.
class Monitor {
  public:
    using Clock = std::chrono::steady_clock;
    /// `share`: the completed part of the stage, from 0 to 1.
    using Report = std::function<void(std::string_view stage, double share)>;

    /// A monitor without an observer: it reports and cancels nothing.
    Monitor() = default;
    /// `interrupt`: set when the user wants to stop; may be null. `deadline`: the time limit.
    Monitor(const std::atomic<bool>* interrupt, std::optional<Clock::time_point> deadline, Report report)
        : interrupt_(interrupt), deadline_(deadline), report_(std::move(report)) {}
    Monitor(const Monitor&) = delete;
    Monitor& operator=(const Monitor&) = delete;

    /// The shared monitor without an observer.
    static const Monitor& none();

    bool is_interrupted() const { return interrupt_ && *interrupt_; }
    bool is_time_over() const { return deadline_ && Clock::now() > *deadline_; }
    /// Throws Cancelled where the user has interrupted or the time limit is reached; its message is that of a
    /// set-up. Some 30 ns: for every microsecond or more of work.
    void require_more() const;
    /// Throws Cancelled where the user has interrupted.
    void report(std::string_view stage, double share) const;
    /// Throws Cancelled where the time limit is reached.
    void require_time(std::string_view stage, double share) const;

  private:
    Cancelled time_over(std::string_view where) const;

    const std::atomic<bool>* interrupt_ = nullptr;
    std::optional<Clock::time_point> deadline_;
    Report report_;
    Clock::time_point start_ = Clock::now();
    mutable std::mutex mutex_;
    mutable std::string last_stage_;
    mutable Clock::time_point last_report_;
};

/// A stage of several parts, which may run in parallel. Cancellation leaves no result.
class Stage {
  public:
    /// Throws Cancelled as advance() does.
    Stage(const Monitor& monitor, std::string name, std::size_t parts);

    /// Counts one more part. Throws Cancelled where the user has interrupted or the time limit is reached.
    void advance();

  private:
    void check(std::size_t done) const;

    const Monitor& monitor_;
    std::string name_;
    std::size_t parts_;
    std::atomic<std::size_t> done_ = 0;
};

}  // namespace stilb
