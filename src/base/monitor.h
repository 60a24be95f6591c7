// Watching over work that gives no result before it is complete: how far it is, and whether it goes on.
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

/// Takes reports from any thread, and passes on one at a time, some ten in a second. Outlives what it is
/// given to.
class Monitor {
  public:
    using Clock = std::chrono::steady_clock;
    /// `share`: what is done of the stage, from 0 to 1.
    using Report = std::function<void(std::string_view stage, double share)>;

    /// Nobody watches: nothing is reported, and nothing cancelled.
    Monitor() = default;
    /// `interrupt`: set where the user wants to stop; may be null. `deadline`: when the time is over.
    Monitor(const std::atomic<bool>* interrupt, std::optional<Clock::time_point> deadline, Report report)
        : interrupt_(interrupt), deadline_(deadline), report_(std::move(report)) {}
    Monitor(const Monitor&) = delete;
    Monitor& operator=(const Monitor&) = delete;

    /// The one that nobody watches by.
    static const Monitor& none();

    bool is_time_over() const { return deadline_ && Clock::now() > *deadline_; }
    /// Throws Cancelled where the user has interrupted.
    void report(std::string_view stage, double share) const;
    /// Throws Cancelled where the time is over.
    void require_time(std::string_view stage, double share) const;

  private:
    const std::atomic<bool>* interrupt_ = nullptr;
    std::optional<Clock::time_point> deadline_;
    Report report_;
    Clock::time_point start_ = Clock::now();
    mutable std::mutex mutex_;
    mutable std::string last_stage_;
    mutable Clock::time_point last_report_;
};

/// A stage of several parts, which may be done in parallel. No result is left where it is cancelled.
class Stage {
  public:
    /// Throws Cancelled, as advance().
    Stage(const Monitor& monitor, std::string name, std::size_t parts);

    /// One more part is done. Throws Cancelled where the user has interrupted or the time is over.
    void advance();

  private:
    void check(std::size_t done) const;

    const Monitor& monitor_;
    std::string name_;
    std::size_t parts_;
    std::atomic<std::size_t> done_ = 0;
};

}  // namespace stilb
