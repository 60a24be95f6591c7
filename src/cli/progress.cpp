#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>

namespace stilb::cli {
namespace {

std::atomic<bool> interrupted{false};  // global, because a signal handler has no arguments for it

void on_interrupt(int signal_number) {
    interrupted = true;
    std::signal(signal_number, SIG_DFL);
}

}  // namespace

ProgressLine::ProgressLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
    if (is_terminal_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::show(double elapsed_s, const std::string& text) {
    if (!is_terminal_) return;
    fmt::print(stderr, "\r\033[K{:.1f} s  {}", elapsed_s, text);
    std::fflush(stderr);
}

void TerminalProgress::report_set_up(const SetUp& set_up) {
    line_.show(set_up.elapsed_s, fmt::format("set-up: {}, {:.0f} %", set_up.stage, 100 * set_up.share));
}

/// Error and remaining time; infinite values are left out.
void TerminalProgress::report(const Progress& progress) {
    const std::string error = std::isfinite(progress.attained_error)
                                  ? fmt::format("  error {:.2g} %", 100 * progress.attained_error)
                                  : "";
    const std::string left =
        std::isfinite(progress.remaining_s) ? fmt::format(", about {:.0f} s left", progress.remaining_s) : "";
    line_.show(progress.elapsed_s, fmt::format("{} {}{}{}", progress.samples, samples_, error, left));
}

void add_warnings(RunSummary& result, std::span<const std::string> of_file) {
    result.warnings.insert(result.warnings.begin(), of_file.begin(), of_file.end());
}

void print_warnings(std::span<const std::string> warnings) {
    for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

const std::atomic<bool>& watch_for_interrupt() {
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    return interrupted;
}

}  // namespace stilb::cli
