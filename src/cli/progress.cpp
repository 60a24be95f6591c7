#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>

namespace stilb::cli {
namespace {

std::atomic<bool> interrupted{false};  // a signal handler can reach nothing else

void on_interrupt(int signal_number) {
    interrupted = true;
    std::signal(signal_number, SIG_DFL);
}

}  // namespace

ProgressLine::ProgressLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
    if (is_terminal_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::show(double elapsed_s, const std::string& done, double attained_error,
                        double remaining_s) {
    if (!is_terminal_) return;
    const std::string error =
        std::isfinite(attained_error) ? fmt::format("  error {:.2g} %", 100 * attained_error) : "";
    const std::string left =
        std::isfinite(remaining_s) ? fmt::format(", about {:.0f} s left", remaining_s) : "";
    fmt::print(stderr, "\r\033[K{:.1f} s  {}{}{}", elapsed_s, done, error, left);
    std::fflush(stderr);
}

void TerminalProgress::report(const Progress& progress) {
    line_.show(progress.elapsed_s, fmt::format("{} {}", progress.paths, paths_), progress.attained_error,
               progress.remaining_s);
}

void TerminalPictureProgress::report(const Progress& progress) {
    line_.show(progress.elapsed_s, fmt::format("{} passes", progress.passes), progress.attained_error,
               progress.remaining_s);
}

const std::atomic<bool>& watch_for_interrupt() {
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    return interrupted;
}

}  // namespace stilb::cli
