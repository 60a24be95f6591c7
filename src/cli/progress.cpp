#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>

namespace stilb {
namespace {

std::atomic<bool> interrupted{false};  // a signal handler can reach nothing else

void on_interrupt(int signal_number) {
    interrupted = true;
    std::signal(signal_number, SIG_DFL);
}

}  // namespace

TerminalProgress::TerminalProgress() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

TerminalProgress::~TerminalProgress() {
    if (is_terminal_) fmt::print(stderr, "\r\033[K");
}

void TerminalProgress::report(const Progress& progress) {
    if (!is_terminal_) return;
    const std::string left =
        std::isfinite(progress.remaining_s) ? fmt::format(", about {:.0f} s left", progress.remaining_s) : "";
    fmt::print(stderr, "\r\033[K{:.1f} s  {} paths  error {:.2g} %{}", progress.elapsed_s, progress.paths,
               100 * progress.attained_error, left);
    std::fflush(stderr);
}

const std::atomic<bool>& watch_for_interrupt() {
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    return interrupted;
}

}  // namespace stilb
