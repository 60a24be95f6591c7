#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "io/text/table.h"

namespace stilb::cli {
namespace {

std::atomic<bool> interrupted{false};  // global, because a signal handler has no arguments for it

/// Ends the program as the signal does by itself, but leaves no part of a file behind.
void end_program(int signal_number) {
    if (const char* file = io::unfinished_file()) unlink(file);
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

void on_interrupt(int signal_number) {
    interrupted = true;
    // A terminal that closes sends SIGHUP twice: by the shell and by the system.
    if (signal_number != SIGHUP) std::signal(signal_number, end_program);
}

void handle_signals(void (*handler)(int)) {
    std::signal(SIGINT, handler);
    std::signal(SIGTERM, handler);
    // A program that was started by nohup ignores SIGHUP, and goes on when its terminal closes.
    if (std::signal(SIGHUP, handler) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

/// Writes to stderr. Where that fails, as after the terminal has closed, the run goes on: its results matter
/// more than its messages.
void write_message(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

void print_failure(const std::string& message) { write_message(fmt::format("stilb: {}\n", message)); }

std::FILE* messages_beside(const std::string& output) {
    return io::is_standard_output(output) ? stderr : stdout;
}

ProgressLine::ProgressLine(OffTerminal off_terminal)
    : is_terminal_(isatty(STDERR_FILENO) != 0),
      is_plain_(!is_terminal_ && off_terminal == OffTerminal::plain_lines) {}

ProgressLine::~ProgressLine() {
    if (is_terminal_) write_message("\r\033[K");
}

void ProgressLine::show(double elapsed_s, const std::string& text) {
    constexpr double between_plain_lines_s = 1;
    if (is_terminal_) {
        write_message(fmt::format("\r\033[K{:.1f} s  {}", elapsed_s, text));
    } else if (is_plain_ && (shown_s_ < 0 || elapsed_s - shown_s_ >= between_plain_lines_s)) {
        write_message(fmt::format("{:.1f} s  {}\n", elapsed_s, text));
        shown_s_ = elapsed_s;
    }
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

LoadingProgress::LoadingProgress(ShowProgress show)
    : off_terminal_(show == ShowProgress::everywhere ? OffTerminal::plain_lines : OffTerminal::nothing),
      monitor_(nullptr, std::nullopt, [this](std::string_view stage, double share) {
          const std::lock_guard lock(mutex_);
          stage_ = stage;
          share_ = share;
      }) {
    if (show == ShowProgress::never) return;
    if (show == ShowProgress::everywhere || isatty(STDERR_FILENO) != 0)
        thread_ = std::thread([this] { show_until_the_end(); });
}

LoadingProgress::~LoadingProgress() {
    {
        const std::lock_guard lock(mutex_);
        is_ended_ = true;
    }
    ended_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void LoadingProgress::show_until_the_end() {
    using namespace std::chrono_literals;
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    std::unique_lock lock(mutex_);
    if (ended_.wait_for(lock, 1s, [this] { return is_ended_; })) return;
    ProgressLine line(off_terminal_);
    do {
        const double elapsed_s = std::chrono::duration<double>(Clock::now() - begin).count();
        line.show(elapsed_s, share_ > 0 ? fmt::format("{}, {:.0f} %", stage_, 100 * share_) : stage_);
    } while (!ended_.wait_for(lock, 100ms, [this] { return is_ended_; }));
}

void put_first(std::span<const Warning> of_file, RunSummary& result) {
    result.warnings.insert(result.warnings.begin(), of_file.begin(), of_file.end());
}

void print_warning(std::string_view sentence) { write_message(fmt::format("warning: {}\n", sentence)); }

void print_warnings(std::span<const Warning> warnings) {
    for (const Warning& warning : warnings) print_warning(warning.text);
}

const std::atomic<bool>& watch_for_interrupt() {
    handle_signals(on_interrupt);
    return interrupted;
}

void leave_no_unfinished_files() { handle_signals(end_program); }

}  // namespace stilb::cli
