// The progress, the warnings and the failures of a command, on stderr.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include "base/monitor.h"
#include "base/warning.h"
#include "run/run.h"

namespace stilb::cli {

/// Where a command prints what it has done: stdout, or stderr where its output "-" takes stdout.
std::FILE* messages_beside(const std::string& output);

/// How progress is shown where stderr is not a terminal.
enum class OffTerminal { nothing, plain_lines };

/// Prints the error by which a command fails on stderr. If that cannot be written, only the message is lost.
void print_failure(const std::string& message);

/// Rewrites one line of stderr and clears it at the end. Where stderr is not a terminal, it shows nothing, or
/// a plain line every second.
class ProgressLine {
  public:
    explicit ProgressLine(OffTerminal off_terminal);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(double elapsed_s, const std::string& text);

  private:
    bool is_terminal_, is_plain_;
    double shown_s_ = -1;
};

/// Progress of any run. Requests no unfinished pictures.
class TerminalProgress : public PictureSink {
  public:
    /// `samples`: the name of the run's samples.
    explicit TerminalProgress(std::string samples = "paths", OffTerminal off_terminal = OffTerminal::nothing)
        : samples_(std::move(samples)), line_(off_terminal) {}
    void report_set_up(const SetUp& set_up) override;
    void report(const Progress& progress) override;
    bool wants_picture() override { return false; }
    void show(const run::Pixels&) override {}

  private:
    std::string samples_;
    ProgressLine line_;
};

enum class ShowProgress { never, on_terminal, everywhere };

/// The progress of reading and checking a file, from one second on: most are read in less.
class LoadingProgress {
  public:
    explicit LoadingProgress(ShowProgress show = ShowProgress::on_terminal);
    ~LoadingProgress();
    LoadingProgress(const LoadingProgress&) = delete;
    LoadingProgress& operator=(const LoadingProgress&) = delete;

    const Monitor& monitor() const { return monitor_; }

  private:
    /// Shows the last report again and again: some stages take long without a new one.
    void show_until_the_end();

    OffTerminal off_terminal_;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool is_ended_ = false;
    std::string stage_;
    double share_ = 0;
    Monitor monitor_;
    std::thread thread_;
};

/// Puts the warnings of a scene's file before those of a run.
void put_first(std::span<const Warning> of_file, RunSummary& result);
void print_warning(std::string_view sentence);
void print_warnings(std::span<const Warning> warnings);

/// The flag that is set by the first Ctrl-C after this call, by SIGTERM, and by SIGHUP (the terminal closes);
/// a second Ctrl-C or SIGTERM ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

/// Makes these signals remove a file that is being written before they end the program; until
/// watch_for_interrupt().
void leave_no_unfinished_files();

}  // namespace stilb::cli
