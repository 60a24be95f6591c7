#include "base/monitor.h"

#include <fmt/format.h>

#include <utility>

namespace stilb {
namespace {

constexpr std::chrono::milliseconds kBetweenReports{100};

std::string place(std::string_view stage, double share) {
    return fmt::format(" ({}, {:.0f} % done)", stage, 100 * share);
}

Cancelled interrupted(std::string_view where) {
    return Cancelled(fmt::format("interrupted during set-up{}: there is no result yet", where));
}

}  // namespace

const Monitor& Monitor::none() {
    static const Monitor monitor;
    return monitor;
}

void Monitor::require_more() const {
    if (is_interrupted()) throw interrupted("");
    if (is_time_over()) throw time_over("");
}

void Monitor::report(std::string_view stage, double share) const {
    if (is_interrupted()) throw interrupted(place(stage, share));
    if (!report_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    const Clock::time_point now = Clock::now();
    if (stage == last_stage_ && now - last_report_ < kBetweenReports) return;
    last_stage_ = stage;
    last_report_ = now;
    report_(stage, share);
}

void Monitor::require_time(std::string_view stage, double share) const {
    if (is_time_over()) throw time_over(place(stage, share));
}

Cancelled Monitor::time_over(std::string_view where) const {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    return Cancelled(
        fmt::format("time limit reached during set-up after {:.2g} s{}: there is no result yet. Allow more "
                    "time, or reduce the work: fewer readings or pixels, larger patches.",
                    elapsed_s, where));
}

Stage::Stage(const Monitor& monitor, std::string name, std::size_t parts)
    : monitor_(monitor), name_(std::move(name)), parts_(parts) {
    check(0);
}

void Stage::advance() { check(++done_); }

void Stage::check(std::size_t done) const {
    const double share = parts_ > 0 ? static_cast<double>(done) / static_cast<double>(parts_) : 1;
    monitor_.report(name_, share);
    if (done < parts_) monitor_.require_time(name_, share);
}

}  // namespace stilb
